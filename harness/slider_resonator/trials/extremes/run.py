"""Running the whole matrix in an FMU."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from slider_resonator.trials.extremes.cell import Cell
from slider_resonator.trials.extremes.judge import MOST_COST, broken, judge
from slider_resonator.trials.extremes.verdict import (
    FAILED,
    NO_REFEREE,
    PASSED,
    REFEREE,
    REFUSED,
    Verdict,
)
from slider_resonator.trials.extremes.worker import Broken, Worker, working

LIMIT = 300.0
"""Time, s, in which a cell must be done."""


@dataclass(frozen=True)
class Matrix:
    """The verdicts of an FMU, one for each cell, and the wall time in s."""

    fmu: str
    verdicts: tuple[Verdict, ...]
    wall_time: float

    def by_axis(self) -> dict[str, list[Verdict]]:
        """Return axis to verdicts, in order."""
        groups: dict[str, list[Verdict]] = {}
        for one in self.verdicts:
            groups.setdefault(one.axis, []).append(one)
        return groups

    def count(self, verdict: str) -> int:
        """Return how many cells have this verdict."""
        return sum(one.verdict == verdict for one in self.verdicts)

    @property
    def counts(self) -> dict[str, int]:
        """Return verdict to count."""
        return {verdict: self.count(verdict) for verdict in (PASSED, REFUSED, FAILED)}

    @property
    def passed(self) -> bool:
        """Whether no cell failed."""
        return self.count(FAILED) == 0

    @property
    def dearest(self) -> Verdict | None:
        """The cell with the worst cost of a step over that of a period of its device."""
        ran = [one for one in self.verdicts if one.period_cost > 0.0]
        return max(ran, key=lambda one: one.cost_ratio, default=None)

    @property
    def summary(self) -> str:
        """The counts and the worst cost, in words."""
        lines = [
            f"{len(self.verdicts)} cells: {self.count(PASSED)} passed, "
            f"{self.count(REFUSED)} refused by name, {self.count(FAILED)} failed, none skipped; "
            f"{self.wall_time:.0f} s",
            f"{sum(one.has(REFEREE) for one in self.verdicts)} cells held against a reference as "
            f"well, which gave up in {sum(one.has(NO_REFEREE) for one in self.verdicts)} others",
        ]
        if self.dearest is not None:
            lines.append(
                f"worst cost of a step, per drive period in it but at least one: "
                f"{self.dearest.cost_ratio:.3g} times the median cost of a period of the same "
                f"device (bound {MOST_COST:g}), {1e6 * self.dearest.worst_step:.3g} us "
                f"({self.dearest.name})"
            )
        return "\n".join(lines)


def run_matrix(
    fmu: Path,
    cells: Sequence[Cell],
    progress: Callable[[str, float], None],
    limit: float = LIMIT,
) -> Matrix:
    """Run and judge every cell; FmuError when the FMU cannot be run at all."""
    began = time.perf_counter()
    verdicts = []
    with working(fmu, limit) as worker:
        for index, cell in enumerate(cells):
            progress(f"{fmu.name}: {cell.axis}", index / len(cells))
            verdicts.append(_verdict(worker, cell))
    return Matrix(str(fmu), tuple(verdicts), time.perf_counter() - began)


def _verdict(worker: Worker, cell: Cell) -> Verdict:
    try:
        seen = worker.observe(cell)
    except Broken as error:
        return broken(cell, str(error))
    return judge(cell, seen)
