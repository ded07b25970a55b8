"""The built FMU with LuGre friction against the Taylor reference, from soft to hard bristles."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from tests.fmu.host import Instantiate
from tests.fmu.trajectories import assert_equal, fmu_run
from tests.fmus import both_fmus, native_fmu_only
from tests.problems import DURATION, Problem, under

CASES = {
    "table 1": Problem(),
    "ratio 3": Problem({}, under(frequency_ratio=3.0, phase=0.4)),
    "presliding": Problem({"base_amplitude": 2e-8}),
    "lift-off": Problem({"normal_amplitude": 2.0}, under(load=0.02)),
    "massless resonator": Problem({"resonator_mass": 0.0, "initial_velocity": 0.1}),
    "one degree of freedom": Problem({"fidelity": 1, "friction_faces": 1}, under(phase=0.3)),
}


def on_bristles(case: str, stiffness: float, damping: float) -> Problem:
    lugre = {"friction_law": 1, "bristle_stiffness": stiffness, "bristle_damping": damping}
    problem = CASES[case]
    return replace(problem, parameters={**problem.parameters, **lugre, "tolerance": 1e-9})


@cache
def reference_of(case: str, stiffness: float, damping: float, duration: float) -> Trajectory:
    """The reference at a hundred moments, for both FMUs."""
    problem = on_bristles(case, stiffness, damping)
    held = replace(problem.held[0], stop=duration)
    return simulate(problem.device, [held], np.linspace(0.0, duration, 101)[1:])


@both_fmus
@pytest.mark.parametrize(
    ("stiffness", "damping", "duration"),
    [
        (50.0, 10.0, DURATION / 4),
        (1e4, 0.0, DURATION / 4),
        (1e6, 10.0, DURATION / 4),
        (1e8, 0.0, DURATION / 4),
        pytest.param(1e5, 10.0, DURATION, marks=pytest.mark.slow),
    ],
)
@pytest.mark.parametrize("case", CASES)
def test_motion_is_that_of_the_reference(
    instantiate: Instantiate, case: str, stiffness: float, damping: float, duration: float
) -> None:
    reference = reference_of(case, stiffness, damping, duration)
    signals, ends = fmu_run(instantiate, on_bristles(case, stiffness, damping), reference.time)
    assert_equal(signals, reference, 1e-6)
    assert ends["reversals"] == reference.reversals, "reversals seen by the reference"


SMALL = {
    "slow drive": ({"drive_frequency": 34.0}, 0.6),
    "slow drive, hard bristles": ({"drive_frequency": 34.0, "bristle_stiffness": 1e7}, 0.4),
    "slow drive, no damping": ({"drive_frequency": 34.0, "bristle_damping": 0.0}, 0.4),
    "heavy preload": ({"normal_preload": 6.9e6}, 2e-4),
    "weak drive": ({"base_amplitude": 1e-15}, 0.05),
}
"""Parameters other than table 1, and durations (s), of motion far slower than sliding."""


@native_fmu_only
@pytest.mark.parametrize("case", SMALL)
def test_small_signals_are_held_to_the_tolerance(instantiate: Instantiate, case: str) -> None:
    """That of each signal's own peak, tenfold for the sum over the run."""
    parameters, duration = SMALL[case]
    problem = Problem({"friction_law": 1, "tolerance": 1e-8, **parameters})
    held = replace(problem.held[0], stop=duration)
    reference = simulate(problem.device, [held], np.linspace(0.0, duration, 41)[1:])
    signals, _ = fmu_run(instantiate, problem, reference.time)
    assert_equal(signals, reference, 1e-7)
