"""Hands the points of a sweep to workers, and keeps what they return."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from typing import Protocol

from slider_resonator.sweeping.measures import Task
from slider_resonator.sweeping.worker import Point, Row, Rows, failed_row

CHUNK_SECONDS = 0.2
"""Work in a chunk: much longer than sending it takes; a killed worker loses no more than that."""
LARGEST_CHUNK = 200
CHUNKS_EACH = 2
"""Chunks queued for each worker, so that it never waits."""


class Workers(Protocol):
    """Processes, here or elsewhere, that compute chunks."""

    losses: tuple[type[BaseException], ...]
    """The errors that the result of a chunk raises when its worker died."""
    attempts: int
    """Workers that may die at a point before it counts as the cause."""

    @property
    def count(self) -> int:
        """How many chunks are computed at once."""

    def submit(self, points: Sequence[Point]) -> Future[Rows]:
        """Begin to compute a chunk."""

    def replace_lost(self) -> None:
        """Replace workers after a loss; HarnessError where that is impossible."""


def run_points(
    workers: Workers, task: Task, points: Sequence[Point], keep: Callable[[Sequence[Row]], None]
) -> None:
    """Compute all points, calling `keep` with rows as they come, in any order.

    After a worker has died, the points that it may have been computing are computed one at a time,
    so that a point that kills every worker is identified and has an error as its row.
    """
    waiting, suspects = deque(points), deque[Point]()
    pending: dict[Future[Rows], list[Point]] = {}
    deaths: dict[int, int] = {}
    seconds = CHUNK_SECONDS  # estimate of the time of a point

    def submit(chunk: list[Point]) -> None:
        try:
            pending[workers.submit(chunk)] = chunk
        except workers.losses:
            suspects.extend(chunk)

    lost = False
    while waiting or suspects or pending:
        if suspects and not pending:
            if lost:
                workers.replace_lost()
                lost = False
            submit([suspects.popleft()])
        while waiting and not suspects and len(pending) < CHUNKS_EACH * workers.count:
            size = max(1, min(LARGEST_CHUNK, int(CHUNK_SECONDS / seconds)))
            submit([waiting.popleft() for _ in range(min(size, len(waiting)))])
        if not pending:
            lost = True  # not even a chunk could be handed over
            continue
        for future in wait(pending, return_when=FIRST_COMPLETED).done:
            chunk = pending.pop(future)
            try:
                rows, duration = future.result()
            except workers.losses:
                lost = True
                alone = len(chunk) == 1 and not pending
                if alone:
                    number = chunk[0][0]
                    deaths[number] = deaths.get(number, 0) + 1
                    if deaths[number] >= workers.attempts:
                        keep([failed_row(task, number, "the worker process died at this point")])
                        continue
                suspects.extend(chunk)
            else:
                keep(rows)
                seconds = max(duration / len(rows), 1e-6)
