"""Steady motion and blocking force: of the built FMU, of references, and of averages."""

from math import pi, sqrt

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUTS
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged import device_average
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.steady.reference_steady import ReferenceMotion
from slider_resonator.steady.searches import (
    FIRM,
    FmuPeriodMap,
    find_blocking,
    find_steady,
    repeating_periods,
)
from slider_resonator.steady.shooting import NoPeriodicMotion, blocked_point
from studies.paper.mapping import lugre_case, stiffness_of

Values = dict[str, float]
PERIOD = 2.0 * pi / 3500.0
LUGRE = {"friction_law": 1.0}
IN_FLIGHT = {"frequency_ratio": 2.0, "normal_amplitude": 3.0}


@pytest.mark.parametrize(
    ("values", "status", "reason"),
    [
        ({"load": 0.25}, "load_above_friction", "0.25 N is not below the 0.2 N"),
        ({**LUGRE, "bristle_stiffness": 50.0, "load": 2.5}, "load_above_friction", ""),
        ({"frequency_ratio": 1.001}, "slow_beat", "0.557042 Hz"),
        ({"frequency_ratio": 1.37}, "no_common_period", ""),
        ({"friction_coefficient": 0.0}, "not_unique", ""),
        # Even ratios with flight while sliding turns; the search begins at an end of the family.
        ({**IN_FLIGHT, "phase": 0.3}, "not_unique", ""),
        ({**IN_FLIGHT, "phase": 1.0, "normal_amplitude": 2.0}, "not_unique", ""),
        ({**IN_FLIGHT, "phase": 2.5, "frequency_ratio": 4.0}, "not_unique", ""),
        ({**IN_FLIGHT, "phase": 2.5, "frequency_ratio": -2.0}, "not_unique", ""),
        # Near V = 0 the slips forward and backward keep their impulses, whatever V is.
        ({**IN_FLIGHT, "normal_amplitude": 1.5, "phase": pi / 2.0 - 1.466}, "not_unique", ""),
        (
            {"damping_ratio": 0.0, "resonator_frequency": 3500.0 * sqrt(1.0 / 1.1)},
            *("no_fixed_point", "damping_ratio = 0"),
        ),
    ],
)
def test_no_steady_motion(instance: Instance, values: Values, status: str, reason: str) -> None:
    motion = find_steady(instance, values)
    assert (motion.steady_velocity, motion.status) == (None, status)
    assert reason in motion.reason


def test_deviations_of_the_drive_are_among_the_inputs(instance: Instance) -> None:
    values = {"frequency_deviation": 0.02, "amplitude_deviation": 0.0}
    for motion in (find_steady(instance, values), find_blocking(instance, values)):
        (line,) = [line for line in motion.describe() if line.startswith("inputs")]
        assert line.endswith(", frequency_ratio 1, frequency_deviation 0.02")


def test_a_kept_jacobian_that_does_not_help_is_renewed(instance: Instance) -> None:
    values = {"phase": 5.83, "normal_amplitude": 1.3, "frequency_ratio": 0.5}
    resonator = {"base_amplitude": 1e-5, "resonator_frequency": 1e3, "damping_ratio": 0.01}
    run, far = FmuPeriodMap(instance, {**values, **resonator}), 0.11
    run.drive_periods = 2
    load, _ = blocked_point(run, *run.warm_up(0.0, far), far, run.friction)
    assert load == pytest.approx(-0.038269024, rel=1e-6)
    assert load == pytest.approx(find_blocking(instance, {**values, **resonator}).blocking_force)


def test_no_blocking_force(instance: Instance) -> None:
    still = {"base_amplitude": 0.0, "normal_amplitude": 0.5}
    for values, status in ((still, "stuck"), ({"frequency_ratio": 1.001}, "slow_beat")):
        blocking = find_blocking(instance, values)
        assert (blocking.blocking_force, blocking.status) == (None, status)


@pytest.mark.parametrize(
    "values",
    [
        {"phase": 0.4},
        {"friction_faces": 1.0},
        {"fidelity": 1.0},
        {**LUGRE, "phase": 0.4},
        {**LUGRE, "friction_faces": 1.0},
        {**LUGRE, "fidelity": 1.0, "bristle_stiffness": 1e4},
        {**LUGRE, "bristle_stiffness": 50.0},
        {**LUGRE, "bristle_stiffness": 1e6},
    ],
)
def test_searches_find_what_the_reference_has(instance: Instance, values: Values) -> None:
    values = {**values, "tolerance": 1e-11}
    device = Device.from_mapping({n: v for n, v in values.items() if n not in INPUTS})
    phase = values.get("phase", 0.0)
    motion, blocking = find_steady(instance, values), find_blocking(instance, values)
    assert (motion.status, blocking.status) == ("steady", "blocked")
    assert max(motion.periods, blocking.periods) <= 100, "with bristles, too"
    reference = ReferenceMotion(device, phase, 1.0)
    velocity, force = reference.steady_velocity(0.0, motion.predicted), reference.blocking_force()
    assert motion.steady_velocity == pytest.approx(velocity, abs=1e-7)
    assert blocking.blocking_force == pytest.approx(force, abs=1e-7)


@pytest.mark.parametrize("stiffness", [50.0, 1e6])
@pytest.mark.parametrize(
    "changed",
    [
        {"phase": -pi / 2.0},  # the normal force vanishes at the end of each period
        {"phase": -1.2, "normal_amplitude": 3.0},  # lifted there
        {"phase": 4.2, "normal_amplitude": 30.0, "frequency_ratio": -1.0},  # half the period
        {"phase": -2.0, "normal_amplitude": 2.0, "frequency_ratio": 0.5},
        {"phase": -1.5, "normal_amplitude": 1.5, "frequency_ratio": 1.5},
        {"phase": 0.4, "frequency_ratio": 3.0},
        {"phase": 0.4, "load": 0.05},
        {"normal_preload": 0.0},
    ],
)
def test_steady_state_stays(instance: Instance, stiffness: float, changed: Values) -> None:
    values = {**LUGRE, "bristle_stiffness": stiffness, "tolerance": 1e-11, **changed}
    motion = find_steady(instance, values)
    assert motion.status == "steady"
    assert motion.common_period is not None
    instance.start({**values, **{f"initial_{name}": x for name, x in motion.state.items()}})
    begin = instance.value("position")
    for period in range(1, 51):
        instance.step_to(period * motion.common_period * PERIOD)
    mean = (instance.value("position") - begin) / instance.time
    assert mean == pytest.approx(motion.steady_velocity, abs=1e-9)
    assert instance.value("velocity") == pytest.approx(motion.state["velocity"], abs=1e-9)


def test_damped_bristles_hold_loads_above_sliding_friction(instance: Instance) -> None:
    """(24) can exceed mu N0: a load above full sliding friction is no obstacle of its own."""
    motion = find_steady(instance, {**LUGRE, "bristle_stiffness": 50.0, "load": 0.5})
    assert motion.status == "steady"
    assert motion.steady_velocity is not None
    assert motion.steady_velocity > 0.1


@pytest.mark.parametrize("amplitude", [0.0, 0.5, 1.0, 1.5, 4.0])
def test_friction_limit_is_that_of_the_clipped_sine(amplitude: float) -> None:
    angle = (np.arange(200_000) + 0.5) / 200_000 * 2.0 * pi
    mean = np.maximum(0.0, 1.0 + amplitude * np.sin(angle)).mean()
    device = Device(normal_amplitude=amplitude)
    limit = device_average.full_friction(device, 0.0, 1.0)
    assert limit == pytest.approx(2.0 * 0.1 * mean, rel=1e-9), "faces mu N"
    still = device_average.full_friction(device, -pi / 6.0, 0.0)
    assert still == pytest.approx(0.2 * max(0.0, 1.0 - 0.5 * amplitude))


@pytest.mark.parametrize(
    "changed",
    [
        {"friction_law": 0.0},
        {"fidelity": 0.0},
        {"bristle_stiffness": 0.0},
        {"normal_preload": 0.0, "normal_amplitude": 0.0},
        {"frequency_ratio": 0.0, "phase": -pi / 2.0, "normal_amplitude": 2.0},
    ],
)
def test_a_bristle_without_friction_does_not_matter(instance: Instance, changed: Values) -> None:
    assert FmuPeriodMap(instance, LUGRE).bends
    assert not FmuPeriodMap(instance, {**LUGRE, **changed}).bends


def test_outputs_must_follow_inputs(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
    set_values = instance.set
    monkeypatch.setattr(instance, "set", lambda new: None if new is FIRM else set_values(new))
    with pytest.raises(FmuError, match=r"normal_force = .* N must be the normal_preload of 1\.0 N"):
        find_steady(instance, {**LUGRE, "phase": 0.4})


@pytest.mark.parametrize(
    ("ratio", "status"),
    [
        *((ratio, "slow_beat") for ratio in (1.0999, 2.9001, -0.9871)),
        *((ratio, "no_common_period") for ratio in (1.1001, 1.37, -2.4567)),
    ],
)
def test_slow_beat_needs_a_ratio_near_an_integer(ratio: float, status: str) -> None:
    with pytest.raises(NoPeriodicMotion) as none:
        repeating_periods(ratio, PERIOD, 20)
    assert none.value.status == status
    assert f"frequency_ratio = {ratio!r} is no p/q with q <= 20" in none.value.reason
    assert ("Hz" in none.value.reason) == (status == "slow_beat"), "a fast beat is none"


@pytest.mark.parametrize("stiffness", [None, 50.0, 1e5])
def test_maps_can_be_chained(instance: Instance, stiffness: float | None) -> None:
    """What is read at the end of a period must start the next one as if there were no end."""
    values, start = {"tolerance": 1e-12}, np.array([0.1, 1e-4, -0.2])
    if stiffness:
        values |= {"friction_law": 1.0, "bristle_stiffness": stiffness}
        start = np.append(start, 0.3 / stiffness * 0.1)
    period_map = FmuPeriodMap(instance, values)
    period_map.drive_periods = 2
    assert ("bristle_deflection" in period_map.names) == bool(stiffness)
    first, moved = period_map(start, 0.01)
    second, further = period_map(first, 0.01)
    assert period_map.periods == 4
    period_map.drive_periods = 4
    end, displacement = period_map(start, 0.01)
    allowed = 1e-9 if stiffness else 1e-11
    assert end == pytest.approx(second, rel=allowed)
    assert displacement == pytest.approx(moved + further, rel=allowed)


@pytest.mark.slow
def test_what_never_repeats_has_no_steady_motion() -> None:
    assert ReferenceMotion(Device(), 0.0, 1.001).steady_velocity(0.0) is None
    assert ReferenceMotion(Device(), 0.0, 1.001).blocking_force() is None
    for device, load in ((Device(), 0.25), (Device(friction_law=1), 3.0)):
        found = ReferenceMotion(device, 0.0, 1.0).steady_velocity(load)
        assert found is None, "a load above friction"


QUICK = (0.1, 10.0)
KAPPAS = [
    pytest.param(kappa, marks=() if kappa in QUICK else pytest.mark.slow)
    for kappa in (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)
]


@pytest.mark.parametrize("amplitude_ratio", [0.8, 1.6])
@pytest.mark.parametrize("kappa", KAPPAS)
def test_errors_of_averages_fall_with_the_frequency(kappa: float, amplitude_ratio: float) -> None:
    """Soft to hard bristles, closed and lifting: velocity and blocking force of model 2."""
    errors, case = [], LugreCase(amplitude_ratio=amplitude_ratio)
    for frequency in (1000.0, 4000.0):
        values = lugre_case(case, frequency, stiffness_of(kappa, case, frequency))
        del values["phase"]
        device = Device.from_mapping(values)
        averages = (
            device_average.steady_velocity(device, 1.0, 0.0, 1.0),
            device_average.blocking_force(device, 1.0, 1.0),
        )
        exact = (
            ReferenceMotion(device, 1.0, 1.0).steady_velocity(0.0, averages[0]),
            ReferenceMotion(device, 1.0, 1.0).blocking_force(),
        )
        errors.append(np.subtract(averages, np.array(exact, dtype=float)))
    for coarse, fine in zip(*errors, strict=True):
        assert abs(coarse) < 2e-3, "of v_q, or of N0"
        assert coarse / fine == pytest.approx(4.0, rel=0.02), "averages err by 1 / Omega"
