"""The cells of the matrix: each passes, or is refused with name, value and requirement.

All are run each night, here some of each axis and model.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pytest

from slider_resonator.stress.case import MatrixCell
from slider_resonator.stress.judge import MAX_RELATIVE_COST
from slider_resonator.stress.matrix import all_cells
from slider_resonator.stress.run import Matrix, run_matrix
from slider_resonator.stress.verdict import FAILED, REFERENCE, REFUSED

EVERY, EVERY_OF_SECOND_ORDER = 17, 41
"""Of how many cells the Python FMU runs one, and of those of second-order averages. Prime: the
models take turns in the list, and each is to be tried."""
NATIVE, NATIVE_OF_SECOND_ORDER = 7, 23
"""The same for the native FMU."""

LUGRE = {f"LuGre, fidelity {n}" for n in range(3)}
STEADY_FORCE = {f"{law}, fidelity {n}" for law in ("Coulomb", "LuGre") for n in range(2)}
STEADY_FORCE |= {"Coulomb, fidelity 0, order 2"}
UNDAMPED = ("drive at slip, xi 0", "drive 1 ulp below slip, xi 0", "drive 1 ulp above slip, xi 0")

WITHOUT_MEANING = {
    # Without friction a bristle bends at no rate (8).
    *(f"mu: 0: {model}" for model in (*LUGRE, "LuGre, fidelity 0, order 2")),
    *(f"free ringing: xi 0, mu 0: {model}" for model in LUGRE),
    # The steady force of an undamped resonator at its resonance is unbounded.
    *(f"resonance: {value}: {model}" for value in UNDAMPED for model in STEADY_FORCE),
    # Damper and bristles turn a slider of a nanogram within 1e-11 s.
    "r_m: 1 - 1e-9: LuGre, fidelity 2",
}


LONG_FOR_PYTHON = frozenset(f"communication step: 1e4 s: LuGre, fidelity {n}" for n in (1, 2))
"""Steps whose series would take the Python FMU minutes: it refuses them by its bound of work."""


def cells_in_part(every: int, of_second_order: int) -> list[MatrixCell]:
    """One cell in so many of the matrix, of second-order averages and of the other models."""
    second_order = [cell for cell in all_cells() if "order 2" in cell.name]
    others = [cell for cell in all_cells() if "order 2" not in cell.name]
    return [*others[::every], *second_order[::of_second_order]]


@pytest.mark.parametrize(
    "shares", [(EVERY, EVERY_OF_SECOND_ORDER), (NATIVE, NATIVE_OF_SECOND_ORDER)]
)
def test_each_model_has_its_share(shares: tuple[int, int]) -> None:
    def counted(cells: Sequence[MatrixCell]) -> Counter[str]:
        return Counter(cell.name.rpartition(": ")[2] for cell in cells)

    part, every = counted(cells_in_part(*shares)), counted(all_cells())
    assert part.keys() == every.keys()
    for model, count in every.items():
        share = shares["order 2" in model]
        assert part[model] >= 0.7 * count / share, model


def judged(fmu: Path, cells: list[MatrixCell], too_long: frozenset[str] = frozenset()) -> Matrix:
    matrix = run_matrix(fmu, cells, lambda _name, _share: None)
    failed = [f"{one.name}: {one.reason}" for one in matrix.verdicts if one.verdict == FAILED]
    assert failed == []
    assert [one.name for one in matrix.verdicts] == [cell.name for cell in cells], "none skipped"
    # Values that leave the range of numbers may be refused by name: that is what their axis tries.
    beyond = {cell.name for cell in cells if cell.axis == "overflow"}
    refused = {one.name for one in matrix.verdicts if one.verdict == REFUSED} - beyond
    assert refused == (WITHOUT_MEANING | too_long) & {cell.name for cell in cells}
    return matrix


@pytest.mark.slow
def test_native(native_fmu: Path) -> None:
    cells = cells_in_part(NATIVE, NATIVE_OF_SECOND_ORDER)
    matrix = judged(native_fmu, cells)
    assert sum(matrix.counts.values()) == len(cells)
    has_reference = sum(one.has(REFERENCE) for one in matrix.verdicts)
    assert has_reference >= 0.6 * len(cells), "most cells have a reference"
    assert f"{has_reference} cells compared with a reference" in matrix.summary
    assert matrix.most_expensive is not None
    assert f"(bound {MAX_RELATIVE_COST:g})" in matrix.summary, "the worst cost of a step is printed"
    assert matrix.most_expensive.cost_ratio <= MAX_RELATIVE_COST


@pytest.mark.slow
def test_python(python_fmu: Path) -> None:
    judged(python_fmu, cells_in_part(EVERY, EVERY_OF_SECOND_ORDER), LONG_FOR_PYTHON)
