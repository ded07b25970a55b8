"""What happens when workers die, without any process."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future

import pytest

from slider_resonator.sweeping.measures import Run, Task
from slider_resonator.sweeping.running import run_points
from slider_resonator.sweeping.worker import Point, Row, Rows

TASK = Task(("phase",), (), ("steady_velocity",), 20, Run(1, 1, 0))
POINTS: list[Point] = [(number, (0.1 * number,)) for number in range(300)]


class Death(Exception):
    """A worker died."""


class Mortal:
    """Workers that die at deadly points, and `accidents` times for no reason of the points."""

    losses: tuple[type[BaseException], ...] = (Death,)
    attempts = 3
    count = 2

    def __init__(self, deadly: Sequence[int] = (), accidents: int = 0) -> None:
        self.deadly = deadly
        self.accidents = accidents
        self.broken = False
        self.replaced = 0
        self.chunks: list[int] = []

    def submit(self, points: Sequence[Point]) -> Future[Rows]:
        if self.broken:
            raise Death
        future: Future[Rows] = Future()
        self.chunks.append(len(points))
        by_accident = self.accidents > 0 and len(self.chunks) > 5
        if by_accident or any(number in self.deadly for number, _ in points):
            self.accidents -= by_accident
            self.broken = True
            future.set_exception(Death())
        else:
            rows: list[Row] = [(n, [value, "steady"], None) for n, (value,) in points]
            future.set_result((rows, 0.01 * len(points)))
        return future

    def replace_lost(self) -> None:
        self.broken = False
        self.replaced += 1


def _run(workers: Mortal) -> dict[int, Row]:
    kept: list[Row] = []
    run_points(workers, TASK, POINTS, kept.extend)
    assert sorted(row[0] for row in kept) == list(range(300)), "each point is computed once"
    return {row[0]: row for row in kept}


def test_all_points_are_computed_in_chunks_that_grow_to_a_fifth_of_a_second() -> None:
    workers = Mortal()
    _run(workers)
    assert workers.chunks[0] == 1
    assert max(workers.chunks) == 20, "points take 10 ms"


def test_points_that_kill_workers_have_an_error_and_no_other_point_has() -> None:
    rows = _run(Mortal(deadly=(7, 150, 151, 299)))
    failed = {number: row[2] for number, row in rows.items() if row[2] is not None}
    assert failed == dict.fromkeys((7, 150, 151, 299), "the worker process died at this point")
    assert rows[7][1] == [None, None]


@pytest.mark.parametrize("accidents", [1, 2])
def test_workers_killed_from_outside_cost_no_point(accidents: int) -> None:
    workers = Mortal(accidents=accidents)
    rows = _run(workers)
    assert all(row[2] is None for row in rows.values())
    assert workers.replaced >= 1
