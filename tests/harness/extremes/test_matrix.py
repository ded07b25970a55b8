from __future__ import annotations

from collections import Counter

from harness.extremes.cell import Cell, Hold, Model
from harness.extremes.matrix import all_cells

AXES = {
    "Omega",
    "q",
    "alpha",
    "mu",
    "r_m",
    "xi",
    "resonance",
    "critical damping",
    "frequency ratio",
    "blocking load",
    "load at full friction",
    "bristle stiffness",
    "bristle damping",
    "tolerance",
    "communication step",
    "start time",
    "drive periods",
    "grazing release",
    "simultaneous",
    "inputs jump every step",
    "state restored",
}


def test_every_axis_is_there() -> None:
    assert {cell.axis for cell in all_cells()} >= AXES


def test_names_are_unique() -> None:
    counts = Counter(cell.name for cell in all_cells(long=True))
    assert [name for name, count in counts.items() if count > 1] == []


def test_other_steps_cover_the_same_times() -> None:
    for cell in all_cells():
        total = sum(hold.size * hold.count for hold in cell.holds)
        other = sum(hold.size * hold.count for hold in cell.other_holds)
        assert abs(other - total) <= 1e-12 * total, cell.name
        assert cell.other_holds != cell.holds or total == 1e4, cell.name


def test_steps_that_cannot_be_cut_are_kept() -> None:
    cell = Cell("step", "denormal", Model(2, 0), {}, (Hold(5e-324), Hold(1e-3)))
    assert [hold.count for hold in cell.other_holds] == [1, 3]
