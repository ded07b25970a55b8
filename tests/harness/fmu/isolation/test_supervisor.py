"""How soon the supervisor sees what a program has started."""

import select
import socket
import time
from collections.abc import Iterator

import pytest

from slider_resonator.fmu.isolation import supervisor

PROGRAM = 1000


class Clock:
    """A clock on which a wait takes a poll interval, and counting processes takes `cost` (s)."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, cost: float, counts: Iterator[int]) -> None:
        self.now = 0.0
        self.counted: list[float] = []
        self._cost = cost
        self._counts = counts
        monkeypatch.setattr(time, "monotonic", lambda: self.now)
        monkeypatch.setattr(select, "select", self._wait)
        monkeypatch.setattr(supervisor, "_reaped", list)
        monkeypatch.setattr(supervisor, "_descendants", self._count)

    def _wait(self, *waited: object) -> tuple[list[int], list[int], list[int]]:
        self.now += supervisor.POLL_INTERVAL
        return [], [], []

    def _count(self) -> list[int]:
        self.counted.append(self.now)
        self.now += self._cost
        return list(range(PROGRAM, PROGRAM + next(self._counts)))


@pytest.mark.parametrize(("cost", "interval"), [(0.001, 0.1), (0.02, 0.5), (0.5, 1.0)])
def test_processes_are_counted_as_often_as_that_is_cheap(
    monkeypatch: pytest.MonkeyPatch, cost: float, interval: float
) -> None:
    clock = Clock(monkeypatch, cost, iter([1, 1, 1, supervisor.MAX_PROCESSES + 1]))
    with socket.socket() as control:
        ended = supervisor._watch(PROGRAM, control, wakeup=control.fileno(), max_memory=1 << 30)
    assert ended == {"processes": supervisor.MAX_PROCESSES + 1}
    first, *_, before, last = clock.counted
    assert first <= supervisor.POLL_INTERVAL, "at once"
    assert last - before <= interval + cost + supervisor.POLL_INTERVAL


def test_shared_pages_are_counted_above_the_limit_only(monkeypatch: pytest.MonkeyPatch) -> None:
    shares: list[int] = []

    def share(process: int) -> int:
        shares.append(process)
        return 40

    monkeypatch.setattr(supervisor, "_memory", lambda process: 100)
    monkeypatch.setattr(supervisor, "_share", share)
    assert supervisor._memory_of_all([1, 2, 3], 300) == 300
    assert not shares
    assert supervisor._memory_of_all([1, 2, 3], 299) == 120
    assert shares == [1, 2, 3]
