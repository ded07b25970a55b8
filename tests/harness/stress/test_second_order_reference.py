"""Motion that leaps over periods in the matrix is compared with the resolved motion."""

from __future__ import annotations

from dataclasses import replace

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.stress.case import Hold, MatrixCell, Model
from slider_resonator.stress.equality import has_reference
from slider_resonator.stress.judge import judge
from slider_resonator.stress.matrix import all_cells
from slider_resonator.stress.observe import NAMES, Observation, observe
from slider_resonator.stress.verdict import FAILED, PASSED, REFERENCE

CELL = MatrixCell("table 1", "order 2", Model(0, 0, 2), {}, (Hold(0.25, 4, load=0.02),))


@pytest.fixture(scope="module")
def seen(instance: Instance) -> Observation:
    return observe(instance, CELL)


def test_leaps_agree(seen: Observation) -> None:
    verdict = judge(CELL, seen)
    assert verdict.verdict == PASSED, verdict.reason
    (check,) = [check for check in verdict.checks if check.name == REFERENCE]
    assert 0.0 < check.found < 1.0


def test_averages_of_first_order_would_fail(instance: Instance) -> None:
    first = observe(instance, replace(CELL, model=Model(0, 0)))
    full = observe(instance, CELL)
    verdict = judge(CELL, replace(full, outputs=first.outputs))
    assert verdict.verdict == FAILED
    assert "reference: centre velocity" in verdict.reason


@pytest.mark.parametrize(("name", "size"), [("velocity", 1e-5), ("position", 1e-5)])
def test_a_slow_motion_that_is_slightly_off_fails(
    seen: Observation, name: str, size: float
) -> None:
    outputs = seen.outputs.copy()
    outputs[-1, NAMES.index(name)] += size
    wrong = judge(CELL, replace(seen, outputs=outputs))
    assert wrong.verdict == FAILED
    assert "reference" in wrong.reason


def test_most_cells_with_slow_motion_are_covered() -> None:
    cells = [cell for cell in all_cells() if cell.model.second_order]
    assert sum(map(has_reference, cells)) > 0.6 * len(cells)
    left = {cell.axis for cell in cells if not has_reference(cell)}
    assert not left & {"Omega", "blocking load", "neutral motions", "start in flight"}
