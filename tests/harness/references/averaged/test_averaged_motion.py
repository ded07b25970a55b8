from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import AveragedMotion, simulate_averaged
from slider_resonator.references.averaged.device_average import steady_velocity
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory

PERIOD = 2.0 * np.pi / 3500.0
COULOMB = Device(fidelity=0)
BRISTLES = Device(fidelity=0, friction_law=1)
STRONG_FRICTION = 0.5
"""It moves the slow velocity by a fair share of v_q within 100 drive periods."""


def at_factor(device: Device, factor: float) -> Device:
    """The device at a higher drive frequency: fast velocity, slow motion and kappa stay."""
    return replace(
        device,
        base_amplitude=device.base_amplitude / factor,
        drive_frequency=device.drive_frequency * factor,
        resonator_frequency=device.resonator_frequency * factor,
        bristle_stiffness=device.bristle_stiffness * factor,
        initial_resonator_displacement=device.initial_resonator_displacement / factor,
    )


def both(
    device: Device, held: Sequence[HeldInputs], count: int
) -> tuple[AveragedMotion, Trajectory]:
    times = np.linspace(held[0].start, held[-1].stop, count + 1)
    resolved = replace(device, fidelity=2)
    return simulate_averaged(device, held, times), simulate(resolved, held, times)


CASES: dict[str, tuple[Device, dict[str, float]]] = {
    "Coulomb": (COULOMB, {"phase": 0.4, "load": 0.05}),
    "Coulomb, ratio 3": (COULOMB, {"phase": 0.4, "frequency_ratio": 3.0}),
    "Coulomb, lifting": (replace(COULOMB, normal_amplitude=2.0), {"phase": 0.4}),
    "Coulomb, lifting, ratio 1.37": (
        replace(COULOMB, normal_amplitude=2.0),
        {"frequency_ratio": 1.37, "load": 0.1},
    ),
    "Coulomb, overload": (COULOMB, {"load": 1.4}),
    "soft": (replace(BRISTLES, bristle_stiffness=2e3, bristle_damping=2.0), {"phase": 0.4}),
    "medium": (replace(BRISTLES, bristle_stiffness=3e4), {"phase": 0.4, "load": 0.05}),
    "hard": (replace(BRISTLES, bristle_stiffness=1e7), {"phase": 0.4}),
    "medium, ratio 3": (
        replace(BRISTLES, bristle_stiffness=3e4),
        {"phase": 0.4, "frequency_ratio": 3.0},
    ),
    "medium, lifting": (replace(BRISTLES, normal_amplitude=2.0), {"phase": -0.4}),
    "medium, overload": (BRISTLES, {"load": -1.4}),
}
QUICK = ("Coulomb, lifting", "Coulomb, overload", "soft")


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in CASES],
)
def test_error_falls_with_the_drive_frequency(name: str) -> None:
    device, inputs = CASES[name]
    device = replace(device, friction_coefficient=STRONG_FRICTION)
    errors = []
    for factor in (1.0, 4.0):
        held = [HeldInputs(0.0, 100.0 * PERIOD, **inputs)]
        averaged, resolved = both(at_factor(device, factor), held, 20)
        errors.append(float(np.abs(averaged.position - resolved.position).max()))
    moved = equivalent_force(device).velocity_amplitude * 100.0 * PERIOD
    assert errors[0] < 0.012 * moved, "the position within about 1 % of v_q times time"
    assert errors[1] < 0.4 * errors[0], f"errors {errors} must fall as 1 / Omega"


@pytest.mark.slow
@pytest.mark.parametrize("device", [COULOMB, BRISTLES], ids=["Coulomb", "LuGre"])
def test_input_changes_act_at_once(device: Device) -> None:
    device = replace(
        device,
        friction_coefficient=STRONG_FRICTION,
        initial_position=0.01,
        initial_velocity=0.05,
        initial_resonator_displacement=1e-3,
        initial_resonator_velocity=-1.0,
    )
    held = [
        HeldInputs(0.0, 40.3 * PERIOD, phase=0.3),
        HeldInputs(40.3 * PERIOD, 70.9 * PERIOD, phase=0.3, load=0.5, frequency_ratio=3.02),
        HeldInputs(70.9 * PERIOD, 120.0 * PERIOD, phase=-1.0, frequency_ratio=0.97),
    ]
    averaged, resolved = both(at_factor(device, 3.0), held, 240)
    fast = equivalent_force(device).velocity_amplitude
    deviation = np.abs(averaged.position - resolved.position).max()
    assert deviation < 0.005 * fast * 120.0 * PERIOD, "the same way in each stretch of inputs"
    late = averaged.time > 20.0 * PERIOD
    deviation = np.abs(averaged.velocity - resolved.velocity)[late].max()
    assert deviation < 0.02 * fast, "the fast motion is that of (34) once the resonator is steady"


def test_averaged_motion_starts_with_the_momentum_of_the_drive() -> None:
    device = replace(COULOMB, initial_position=0.2, initial_velocity=0.3)
    motion = simulate_averaged(device, [HeldInputs(0.0, 1e-9)], np.array([0.0, 1e-9]))
    assert (motion.position[0], motion.velocity[0]) == (0.2, 0.3)
    assert motion.mean_velocity == pytest.approx(0.3 + 0.1 * 0.35 / 1.1, rel=1e-6), (
        "V is the initial velocity plus m A w / (M + m)"
    )


@pytest.mark.parametrize("load", [0.0, 0.06])
def test_averaged_motion_settles_at_the_steady_velocity(load: float) -> None:
    held = [HeldInputs(0.0, 60.0, 0.4, load)]
    for device, velocity in (
        (COULOMB, steady_velocity(COULOMB, 0.4, load, 1.0)),
        (BRISTLES, steady_velocity(BRISTLES, 0.4, load, 1.0)),
    ):
        motion = simulate_averaged(device, held, np.array([60.0]))
        assert motion.mean_velocity[0] == pytest.approx(velocity, rel=1e-6)


def test_phase_is_slow_up_to_a_detuning_of_one_tenth() -> None:
    held = [HeldInputs(0.0, 1.0, 0.4, frequency_ratio=ratio) for ratio in (1.0999, 1.1001)]
    times = np.linspace(0.0, 1.0, 400)
    beating, still = (simulate_averaged(COULOMB, [inputs], times) for inputs in held)
    assert (np.diff(still.mean_velocity) < 0.0).all(), "without a slow phase V only decays"
    assert (np.diff(beating.mean_velocity) > 0.0).any(), "with one it swings"


def test_splitting_the_inputs_changes_nothing() -> None:
    whole = [HeldInputs(0.0, 1.0, 0.4, frequency_ratio=1.004)]
    cuts = np.linspace(0.0, 1.0, 12).tolist()
    pieces = [replace(whole[0], start=start, stop=stop) for start, stop in pairwise(cuts)]
    times = np.linspace(0.0, 1.0, 301)
    one, other = (simulate_averaged(BRISTLES, held, times) for held in (whole, pieces))
    for name in ("position", "velocity", "mean_velocity"):
        assert getattr(other, name) == pytest.approx(getattr(one, name), abs=1e-7), name


def test_invalid_averages_are_refused() -> None:
    held = [HeldInputs(0.0, 1.0)]
    with pytest.raises(ValueError, match=r"normal_preload = 0\.0"):
        simulate_averaged(replace(COULOMB, normal_preload=0.0), held, np.array([1.0]))
    with pytest.raises(ValueError, match="within the held inputs"):
        simulate_averaged(COULOMB, held, np.array([2.0]))
    with pytest.raises(ValueError, match="at least one interval"):
        simulate_averaged(COULOMB, [], np.array([1.0]))
