"""The points that have rejected variants of a file: they are likely to reject the next one."""

from __future__ import annotations

import threading
from collections.abc import Sequence

REMEMBERED = 3
"""Points that are remembered of each file."""


class RejectingPoints:
    """The last points that rejected a variant of a file; threads may share it."""

    def __init__(self) -> None:
        self._last: dict[str, list[int]] = {}
        self._lock = threading.Lock()

    def add(self, file: str, point: int) -> None:
        """Note that a variant of the file was rejected at a point."""
        with self._lock:
            points = dict.fromkeys([point, *self._last.get(file, ())])
            self._last[file] = list(points)[:REMEMBERED]

    def first(self, file: str, points: Sequence[int]) -> list[int]:
        """Return the points, with those that rejected variants of the file first."""
        with self._lock:
            last = [point for point in self._last.get(file, ()) if point in points]
        return list(dict.fromkeys([*last, *points]))
