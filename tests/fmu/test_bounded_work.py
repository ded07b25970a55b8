"""The work of one step is bounded: what settles costs little, and the rest is refused by name."""

from __future__ import annotations

import math
import time
from pathlib import Path

import pytest

from tests.fmu.host import OUTPUTS, Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

W = 3500.0
PERIOD = math.tau / W
WEAK = {"fidelity": 0, "averaging_order": 1, "base_amplitude": 1e-10}
"""The drive is some millionth of friction: slow motion settles a million times in ten periods."""

LIGHT = {"friction_law": 1, "slider_mass": 1.1e-9, "resonator_mass": 1.1}
"""Damper and bristles turn a slider of next to no mass within 1e-11 s."""


MANY_WAVES = {"normal_amplitude": 2.0, "frequency_ratio": 100.05}


@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("ratio", [1.0, 3.0, math.pi])
def test_weak_vibration_settles(instantiate: Instantiate, law: int, ratio: float) -> None:
    values = {**WEAK, "friction_law": law, "phase": 0.4, "frequency_ratio": ratio}
    whole = instantiate().initialize(**values)
    whole.step(1000.0 * PERIOD)
    mean, steady, far = whole.get("mean_velocity", "steady_velocity", "position")
    fast = whole.get("resonator_velocity")[0]
    assert mean == pytest.approx(steady, abs=1e-8 * abs(fast)), "it settles"
    parts = instantiate().initialize(**values)
    parts.run(10, 100.0 * PERIOD)
    (near,) = parts.get("position")
    assert near == pytest.approx(far, abs=1e-7 * abs(fast) * 1000.0 * PERIOD), "in any steps"


def test_a_strongly_varying_load_settles(instantiate: Instantiate) -> None:
    """LuGre friction over flight costs a quadrature each time it is asked for."""
    values = {"fidelity": 0, "averaging_order": 1, "friction_law": 1, "normal_amplitude": 1e9}
    instance = instantiate().initialize(**values)
    instance.step(100.0 * PERIOD)
    mean, steady = instance.get("mean_velocity", "steady_velocity")
    assert mean == pytest.approx(steady, rel=1e-6)


@pytest.mark.parametrize(
    ("values", "size", "work", "limit", "carried_out"),
    [
        # Near a whole ratio the slow velocity follows the phase, and never settles.
        ({**WEAK, "frequency_ratio": 1.05}, 1e3, "00 steps of averaged motion", "1e", 1e-3),
        (LIGHT, PERIOD / 32.0, " 20000 segments in a turn of the fastest", "1e-7 s", 1e-9),
    ],
    ids=["a beat", "a slider too light for its bristles"],
)
def test_a_step_of_too_much_work_is_refused(
    instantiate: Instantiate,
    values: dict[str, float],
    size: float,
    work: str,
    limit: str,
    carried_out: float,
) -> None:
    instance = instantiate().initialize(**values)
    refused = f"communicationStepSize = {size!r} refused"
    with instance.refuses(refused, "more work than", work, f"must be at most {limit}"):
        instance.step(size)
    instance.step(carried_out)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("values", "turns"),
    [
        ({}, 3e7),
        ({"friction_law": 1}, 3e6),
        ({"friction_law": 1}, 3e7),
        ({"friction_law": 1, "fidelity": 0, **MANY_WAVES}, 3e7),
        ({"normal_preload": 0.0, "normal_amplitude": 0.0}, 1e9),
    ],
    ids=["Coulomb", "bristles", "bristles, refused by turns", "quadratures", "no events"],
)
def test_no_step_takes_more_than_some_seconds(
    instantiate: Instantiate, fmu: Path, values: dict[str, float], turns: float
) -> None:
    # Some seconds in Python; at most 2 in C, and a margin for a busy machine.
    longest = 20.0 if fmu.stem == "SliderResonatorPy" else 3.0
    instance = instantiate().initialize(phase=0.4, **values)
    instance.step(1e-3)
    before = instance.get(*OUTPUTS)
    for size in (turns * PERIOD, 1e300):
        began = time.process_time()
        with instance.refuses(f"communicationStepSize = {size!r} refused", "at most"):
            instance.step(size)
        assert time.process_time() - began < longest
        assert instance.get(*OUTPUTS) == before, "a refusal leaves the state as it was"
    instance.step(1e-3)


def test_motion_beyond_the_range_of_numbers_is_refused(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(initial_velocity=1e308)
    with instance.refuses("leaves the range of floating point numbers"):
        instance.step(10.0)


@pytest.mark.parametrize(
    ("values", "named"),
    [
        ({"drive_frequency": 1e300, "base_amplitude": 1e300}, "base_amplitude = 1e+300 refused"),
        ({"drive_frequency": 1e200, "frequency_ratio": 1e190}, "drive_frequency = 1e+200 refused"),
        ({"base_amplitude": 1e160}, "base_amplitude = 1e+160 refused"),
        ({"resonator_frequency": 1e170}, "resonator_frequency = 1e+170 refused"),
    ],
)
def test_values_that_leave_the_range_are_named(
    instantiate: Instantiate, values: dict[str, float], named: str
) -> None:
    instance = instantiate().enter_initialization(**values)
    with instance.refuses(named, "must be nearer to"):
        instance.slave.exitInitializationMode()


def test_a_prediction_that_takes_too_much_work_is_not_valid(instantiate: Instantiate) -> None:
    """All maps of a search draw from one budget: a read takes no longer than a few steps may."""
    for ratio, valid in ((1.0, 1.0), (9999.03125, 0.0)):
        instance = instantiate().initialize(normal_amplitude=1.5, frequency_ratio=ratio)
        assert instance.get("prediction_valid") == (valid,)
