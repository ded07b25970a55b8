"""The native FMU against the Python one: the same motion to rounding, the same events."""

import math
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from slider_resonator.device.interface import OUTPUTS
from slider_resonator.device.schedule import Schedule, schedule
from slider_resonator.device.signal import through
from slider_resonator.errors import Refusal
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.run import Record, run
from slider_resonator.scenes.scene import Scene, read_scenes
from slider_resonator.scenes.scene_files import built_in_scenes

COUNTS = ("reversals", "contact_mode")
ROUNDING = 1e-11
"""Largest difference of Coulomb signals, over their peak."""

PERIODS = 10_000.0
"""Drive periods of resolved motion after which rounding adds up to more."""

LEAPS = 10.0
"""Largest difference of motion that leaps, in tolerances and over the peak: each build may err by
some tolerances of its own, as their steps differ."""

AVERAGES = 1e-6
"""The same of averages of first order, which err by more: each build integrates them in its own
way."""

RANDOM = 1e-10
"""The same of random devices: the builds are independent, and some devices amplify rounding."""

PREDICTED = ("steady_velocity", "blocking_force")
PREDICTIONS = 2e-9
"""Largest difference of predictions, over the peak: where friction and load balance weakly, or at
the end of a flat, rounding of friction shows in the velocity."""

BESIDE = {
    **{name: "resonator_velocity" for name in ("velocity", "mean_velocity")},
    **{name: "velocity" for name in ("steady_velocity", "slow_motion_error")},
    "position": "resonator_displacement",
    **{name: "normal_force" for name in ("friction_force", "blocking_force")},
}
"""Larger signals, rounding of which shows in a smaller one."""

MIN_FAST_VELOCITY = 1e-4
"""Smallest fast velocity of the devices below, m/s."""

Twins = tuple[Instance, Instance]


@pytest.fixture(scope="module")
def twins(native_fmu: Path, python_fmu: Path) -> Iterator[Twins]:
    with ExitStack() as stack:
        native, python = (
            stack.enter_context(instantiate(stack.enter_context(open_fmu(fmu))))
            for fmu in (native_fmu, python_fmu)
        )
        yield native, python


def differences(native: Record, python: Record, allowed: float) -> list[str]:
    """Counts that are not equal, and other signals that differ by more than `allowed` of a peak."""
    found = []
    for name in OUTPUTS:
        ours, other = native[name], python[name]
        if name in COUNTS:
            found += [] if np.array_equal(ours, other) else [f"{name}: the twins see other events"]
        elif allowed <= ROUNDING or name != "last_event_time":
            gap = np.abs(ours - other).max()
            bound = max(allowed, PREDICTIONS) if name in PREDICTED else allowed
            if not gap <= bound * scale(name, python):
                found.append(f"{name}: the twins differ by {gap:.3g}")
    return found


def scale(name: str, record: Record) -> float:
    """The peak of a signal and of one beside it."""
    peak = float(np.abs(record[name]).max())
    if name in BESIDE:
        peak = max(peak, float(np.abs(record[BESIDE[name]]).max()))
    if name == "stick_fraction":
        peak = 1.0  # a period: as a time of an event
    if name == "steady_velocity":
        # Where it is 0 it is the fast velocity times the rounding of cos(pi / 2).
        peak = max(peak, MIN_FAST_VELOCITY)
    return max(peak, 1e-300)


def both(twins: Twins, values: Mapping[str, float], course: Schedule) -> tuple[Record, Record]:
    native, python = (run(instance, values, course) for instance in twins)
    return native, python


@pytest.mark.parametrize("law", [0, pytest.param(1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("folder", ["core", pytest.param("thorough", marks=pytest.mark.slow)])
def test_scenes(twins: Twins, folder: str, law: int) -> None:
    """Those with a run that both can do: the Python FMU takes no derivatives of inputs.

    On bristles the builds agree to the tolerance only, to which scenes judge each of them as well.
    """
    files = sorted({file for file in built_in_scenes().values() if file.parent.name == folder})
    found = {
        scene.name: differences_in_run(twins, scene)
        for scene in (scene for file in files for scene in read_scenes(file))
        if scene.stop_time and not scene.interpolates and scene.device.friction_law == law
    }
    assert found
    assert {name: texts for name, texts in found.items() if texts} == {}


def differences_in_run(twins: Twins, scene: Scene) -> list[str]:
    course = scene.schedule()
    device, times = scene.device, course.times[:500]
    if device.fidelity > 0:
        times = times[times <= PERIODS * scene.drive_period]
    native, python = both(twins, scene.parameters, replace(course, times=times))
    allowed = device.tolerance if device.friction_law == 1 else ROUNDING
    if device.fidelity == 0:
        allowed = LEAPS * device.tolerance if device.averaging_order == 2 else AVERAGES
    return differences(native, python, max(allowed, ROUNDING))


ratios = st.one_of(st.sampled_from([1.0, 3.0, 0.0, -1.0, 0.5, 1e-5, 1.01]), st.floats(-3.0, 3.0))
parameters = st.fixed_dictionaries(
    {
        "slider_mass": st.floats(0.02, 3.0),
        "resonator_mass": st.one_of(st.just(0.0), st.floats(0.01, 0.5)),
        "resonator_frequency": st.floats(30.0, 300.0),
        "damping_ratio": st.one_of(st.sampled_from([0.05, 1.0]), st.floats(0.0, 3.0)),
        "normal_preload": st.floats(0.1, 2.0),
        "normal_amplitude": st.floats(0.0, 3.0),
        "base_amplitude": st.floats(1e-5, 2e-3),
        "drive_frequency": st.floats(50.0, 200.0),
        "tangential_force": st.one_of(st.just(0.0), st.floats(-2.0, 2.0)),
        "friction_coefficient": st.floats(0.01, 0.8),
        "friction_faces": st.sampled_from([1, 2]),
        "fidelity": st.sampled_from([0, 1, 2]),
        "averaging_order": st.just(1),
        # Not from rest: there a free slider comes back to rest in each period, a tie for counts.
        "initial_velocity": st.one_of(st.floats(-0.1, -0.003), st.floats(0.003, 0.1)),
        "initial_resonator_displacement": st.one_of(st.just(0.0), st.floats(-1e-3, 1e-3)),
    }
)
# Not so small that only rounding decides when the slider that they move stops.
loads = st.one_of(st.just(0.0), st.floats(1e-9, 1.0), st.floats(-1.0, -1e-9))
courses = st.lists(st.tuples(st.floats(-math.pi, math.pi), loads, ratios), min_size=1, max_size=3)


def course_of(values: Mapping[str, float], inputs: list[tuple[float, float, float]]) -> Schedule:
    """Each triple of inputs for two drive periods, in steps that are no round part of them."""
    period = math.tau / values["drive_frequency"]
    phases, loads, ratios = (
        through([(2.0 * period * k, column[k]) for k in range(len(inputs))])
        for column in zip(*inputs, strict=True)
    )
    stop = 2.0 * period * len(inputs)
    return schedule(stop, 0.37 * period, phase=phases, load=loads, frequency_ratio=ratios)


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(parameters, courses)
def test_coulomb_devices(
    twins: Twins, values: dict[str, float], inputs: list[tuple[float, float, float]]
) -> None:
    """Random cases of the command `stress` are others, with bristles, too."""
    try:
        native, python = both(twins, values, course_of(values, inputs))
    except Refusal:
        assume(False)  # test_refusals.py compares those
    vibrates = values["resonator_mass"] or values["tangential_force"]
    averages = values["fidelity"] == 0 and vibrates
    assert differences(native, python, AVERAGES if averages else RANDOM) == []
