"""Tasks shared by several processes of an FMU, with the outcomes of one that runs them in turn."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from functools import partial
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import pytest

from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation import tasks, tasks_ahead
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.fmu.isolation.tasks import Finished, run_tasks
from slider_resonator.fmu.isolation.tasks_ahead import TasksAhead
from tests.harness.fmu.isolation import tasks_of_tests

Task = Callable[[Instance], Any]
SLOW: Task = tasks_of_tests.own_process
MOVE: Task = partial(tasks_of_tests.position_after, time=0.01)


@pytest.fixture(autouse=True)
def others_start_early(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tasks, "ALONE", 0.0)


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The times (s) at which further processes were opened."""
    times: list[float] = []

    def isolated(*arguments: Any) -> IsolatedFmu:
        times.append(monotonic())
        return IsolatedFmu(*arguments)

    monkeypatch.setattr(tasks_ahead, "IsolatedFmu", isolated)
    return times


def wait_until(done: Callable[[], bool]) -> None:
    deadline = monotonic() + 60.0
    while not done():
        assert monotonic() < deadline
        sleep(0.01)


def outcomes(fmu: Path, given: list[tuple[str, Task]], jobs: int) -> list[tuple[object, ...]]:
    return [
        (one.item, one.result, type(one.error), str(one.error))
        for one in run_tasks(fmu, given, 60.0, name=lambda item: item[0], jobs=jobs)
    ]


def test_processes_share_the_tasks_and_keep_the_order(native_fmu: Path) -> None:
    given = [(str(index), SLOW) for index in range(16)]
    finished = list(run_tasks(native_fmu, given, 60.0, name=str, jobs=3))
    assert [one.item for one in finished] == [item for item, _ in given]
    processes = [one.result for one in finished]
    assert len(set(processes)) == 3
    assert processes[0] != processes[-1], "the others begin at the end"


ABORT, REFUSED = tasks_of_tests.abort, tasks_of_tests.refused


@pytest.mark.parametrize(
    "faults",
    [
        {9: ABORT},
        {8: ABORT, 9: REFUSED},
        {0: REFUSED, 2: ABORT, 5: ABORT, 9: ABORT},
        {2: ABORT, 7: ABORT, 8: ABORT},
    ],
)
def test_outcomes_do_not_depend_on_the_number_of_processes(
    native_fmu: Path, faults: dict[int, Task]
) -> None:
    points = ["a", "b", "c1", "c2", "d", "e", "f", "g", "h", "k1", "k2"]
    given = [(point, faults.get(index, MOVE)) for index, point in enumerate(points)]
    assert outcomes(native_fmu, given, jobs=2) == outcomes(native_fmu, given, jobs=1)


def test_an_fmu_that_fails_at_once_gets_no_further_process(
    native_fmu: Path, opened: list[float]
) -> None:
    given = [("a", tasks_of_tests.abort), *((name, SLOW) for name in "bcd")]
    assert len(list(run_tasks(native_fmu, given, 60.0, name=str, jobs=4))) == 4
    assert opened == []


def test_a_short_run_starts_no_further_process(
    native_fmu: Path, opened: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tasks, "ALONE", 60.0)
    assert len(list(run_tasks(native_fmu, [("a", MOVE)] * 3, 60.0, name=str, jobs=4))) == 3
    assert opened == []


def test_an_fmu_that_runs_only_once_at_a_time_is_run_by_one_process(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def licensed(*_: object) -> IsolatedFmu:
        raise FmuError("all licences are in use")

    monkeypatch.setattr(tasks_ahead, "IsolatedFmu", licensed)
    finished = list(
        run_tasks(native_fmu, [(name, SLOW) for name in "abcd"], 60.0, name=str, jobs=2)
    )
    assert len({one.result for one in finished}) == 1


def test_a_run_that_is_left_ends_the_tasks_at_work(native_fmu: Path, opened: list[float]) -> None:
    given = [("a", SLOW)] * 4 + [("b", tasks_of_tests.hang)]
    with closing(run_tasks(native_fmu, given, 60.0, name=str, jobs=2)) as finished:
        for _ in range(4):
            next(finished)
        assert len(opened) == 1
        began = monotonic()
    assert monotonic() - began < 10.0


def test_a_failure_ends_what_runs_ahead_and_keeps_its_results(native_fmu: Path) -> None:
    ahead = TasksAhead(native_fmu, [MOVE, tasks_of_tests.hang, MOVE], 60.0, processes=1)
    ahead.start()
    wait_until(lambda: 1 in ahead._taken)
    ahead.stop()
    assert ahead.result(0) is None, "not begun"
    assert ahead.result(1) is None, "given up"
    assert ahead.result(2) is not None, "done"
    ahead.end()


def test_an_item_in_work_elsewhere_counts_as_worked_on(native_fmu: Path) -> None:
    working: list[str] = []
    given = [(str(index), SLOW) for index in range(6)]
    run = run_tasks(native_fmu, given, 60.0, name=str, meanwhile=working.append, jobs=2)
    finished: list[Finished[str]] = list(run)
    assert working == [one.item for one in finished]
