"""Averaged motion in the matrix is compared with a reference too."""

from __future__ import annotations

from dataclasses import replace

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.stress.averaged_reference import REFERENCE_ERROR, covers
from slider_resonator.stress.case import Hold, MatrixCell, Model
from slider_resonator.stress.judge import judge
from slider_resonator.stress.matrix import all_cells
from slider_resonator.stress.observe import NAMES, Observation, observe
from slider_resonator.stress.verdict import FAILED, PASSED, REFERENCE

CELL = MatrixCell("table 1", "averaged", Model(0, 0), {}, (Hold(0.01, 20, load=0.02),))


@pytest.fixture(scope="module")
def seen(instance: Instance) -> Observation:
    return observe(instance, CELL)


def test_averaged_motion_agrees(seen: Observation) -> None:
    verdict = judge(CELL, seen)
    assert verdict.verdict == PASSED, verdict.reason
    (check,) = [check for check in verdict.checks if check.name == REFERENCE]
    assert 0.0 < check.found < 0.2, "well within what the reference's steps leave"


@pytest.mark.parametrize(("name", "size"), [("mean_velocity", 0.2366), ("position", 0.02)])
def test_a_mean_friction_that_is_slightly_off_fails(
    seen: Observation, name: str, size: float
) -> None:
    """Sizes are v_q of table 1 and some of the path in 0.2 s; momentum alone bounds neither."""
    outputs = seen.outputs.copy()
    outputs[-1, NAMES.index(name)] += 3.0 * REFERENCE_ERROR * size
    wrong = judge(CELL, replace(seen, outputs=outputs))
    assert wrong.verdict == FAILED
    assert "reference" in wrong.reason


def test_most_averaged_cells_are_covered() -> None:
    averaged = [cell for cell in all_cells() if cell.model in (Model(0, 0), Model(0, 1))]
    left = {cell.axis for cell in averaged if not covers(cell)}
    assert sum(map(covers, averaged)) > 0.8 * len(averaged)
    assert not left & {"Omega", "xi", "critical damping", "frequency ratio", "blocking load"}


@pytest.mark.parametrize(
    "parameters",
    [
        {"friction_coefficient": 0.0},
        {"normal_preload": 0.0},
        {"base_amplitude": 0.0},
        {"resonator_mass": 0.0},
    ],
)
def test_cells_without_an_average_are_left_to_the_other_bounds(
    parameters: dict[str, float],
) -> None:
    assert not covers(replace(CELL, parameters=parameters))
