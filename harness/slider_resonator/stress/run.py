"""Running and judging all cells of the matrix in an FMU."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.fmu.isolation.tasks import run_all_tasks
from slider_resonator.fmu.opening import lacking
from slider_resonator.output.progress import Progress, counted
from slider_resonator.output.readable import number_of
from slider_resonator.stress.case import MatrixCell
from slider_resonator.stress.judge import MAX_RELATIVE_COST, broken, judge
from slider_resonator.stress.observe import observe
from slider_resonator.stress.verdict import (
    FAILED,
    NO_REFERENCE,
    PASSED,
    REFERENCE,
    REFUSED,
    CellVerdict,
)

TIME_LIMIT = 300.0
"""Time limit of a cell, s."""


@dataclass(frozen=True)
class Matrix:
    """The verdicts of an FMU, one for each cell, and the wall time in s.

    An interrupted run has cells that were `not_run`.
    """

    fmu: str
    verdicts: tuple[CellVerdict, ...]
    wall_time: float
    not_run: int = 0

    def by_axis(self) -> dict[str, list[CellVerdict]]:
        """Return axis to verdicts, in order."""
        groups: dict[str, list[CellVerdict]] = {}
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
        """Whether all cells ran and none failed."""
        return not (self.failed or self.not_run)

    @property
    def failed(self) -> bool:
        """Whether a cell failed."""
        return self.count(FAILED) > 0

    @property
    def most_expensive(self) -> CellVerdict | None:
        """The cell with the worst cost of a step relative to a period of its device."""
        ran = [one for one in self.verdicts if one.period_cost > 0.0]
        return max(ran, key=lambda one: one.cost_ratio, default=None)

    @property
    def summary(self) -> str:
        """The counts and the worst cost, in words."""
        compared = sum(one.has(REFERENCE) for one in self.verdicts)
        lines = [
            f"{number_of(len(self.verdicts), 'cell')}: {self.count(PASSED)} passed, "
            f"{self.count(REFUSED)} refused by name, {self.count(FAILED)} failed, "
            f"{f'{self.not_run} not run: incomplete' if self.not_run else 'none skipped'}; "
            f"{self.wall_time:.0f} s",
            f"{number_of(compared, 'cell')} compared with a reference, "
            f"which gave up in {sum(one.has(NO_REFERENCE) for one in self.verdicts)} others",
        ]
        worst = self.most_expensive
        if worst is not None:
            lines.append(
                f"worst cost of a step, per drive period it spans (at least 1): "
                f"{worst.cost_ratio:.3g} times the median cost of a period of the same device "
                f"(bound {MAX_RELATIVE_COST:g}), {1e6 * worst.worst_step:.3g} us ({worst.name})"
            )
        return "\n".join(lines)


def run_matrix(
    fmu: Path,
    cells: Sequence[MatrixCell],
    progress: Progress,
    time_limit: float = TIME_LIMIT,
    keep: Callable[[Matrix], None] = lambda matrix: None,
) -> Matrix:
    """Run and judge every cell; FmuError when the FMU cannot be run at all.

    Cells of second order are left out for an FMU without `averaging_order`. A crash or a missed
    `time_limit` (s) fails its cell only. `keep` is called with what there is
    when the run is interrupted or stopped by an error.
    """
    began = time.perf_counter()
    verdicts: list[CellVerdict] = []
    if "averaging_order" in lacking(fmu):
        cells = [cell for cell in cells if not cell.model.second_order]

    def report(cell: MatrixCell) -> None:
        label = counted(f"{fmu.name}: {cell.axis}", len(verdicts), len(cells))
        progress(label, len(verdicts) / len(cells))

    def matrix() -> Matrix:
        seconds = time.perf_counter() - began
        return Matrix(str(fmu), tuple(verdicts), seconds, len(cells) - len(verdicts))

    tasks = [(cell, partial(observe, cell=cell)) for cell in cells]
    try:
        finished = run_all_tasks(
            fmu,
            tasks,
            time_limit,
            name=lambda cell: cell.name,
            meanwhile=report,
            outcomes=(FmuDied,),
        )
        with closing(finished):
            for cell, result, error in finished:
                verdicts.append(judge(cell, result) if error is None else broken(cell, str(error)))
    except BaseException:
        if verdicts:
            keep(matrix())
        raise
    return matrix()
