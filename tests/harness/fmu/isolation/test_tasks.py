"""Which tasks are run, and how often, where an FMU dies, in one process or several."""

from collections.abc import Callable
from contextlib import closing
from functools import partial
from pathlib import Path
from time import monotonic
from typing import Any

import pytest

from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation import tasks
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu, Outcome
from slider_resonator.fmu.isolation.tasks import LocalProcesses, run_all_tasks, run_tasks
from tests.harness.fmu.isolation.tasks_of_tests import (
    abort,
    hang,
    own_process,
    position_after,
    refused,
)

MOVE = partial(position_after, time=0.01)
Task = Callable[[Instance], Any]
Named = tuple[str, Task]


def die(instance: Instance, over_limit: bool = False) -> None:
    raise FmuDied("as a process of its own would have", over_limit=over_limit)


def ending(outcome: Outcome) -> str:
    if outcome.error is None:
        return "done"
    return "died" if isinstance(outcome.error, FmuDied) else "error"


def test_a_task_that_fails_leaves_the_others_alone(native_fmu: Path) -> None:
    given: list[Named] = [("a", MOVE), ("b", refused), ("c", die), ("d", MOVE)]
    items, outcomes = zip(*run_tasks(native_fmu, given, 60.0, name=str), strict=True)
    assert items == ("a", "b", "c", "d")
    assert [ending(one) for one in outcomes] == ["done", "error", "died", "done"]
    assert outcomes[0].value == outcomes[3].value


def test_tasks_of_one_name_are_left_out_after_a_crash(native_fmu: Path) -> None:
    given: list[Named] = [("a", die), ("a", MOVE), ("b", MOVE)]
    finished = run_tasks(native_fmu, given, 60.0, name=str)
    assert [(item, ending(one)) for item, one in finished] == [("a", "died"), ("b", "done")]


def test_an_fmu_that_keeps_crashing_is_given_up_by_default(native_fmu: Path) -> None:
    given = [(name, die) for name in "abcd"]
    *_, (item, last) = run_tasks(native_fmu, given, 60.0, name=str)
    assert item is None
    assert str(last.error) == "given up after crashes or exceeded limits in a, b, c; not run: d"


def test_all_tasks_are_run_however_many_crash(native_fmu: Path) -> None:
    given = [(name, die) for name in "abcd"]
    with LocalProcesses(native_fmu, 60.0) as processes:
        finished = list(run_all_tasks(processes, given))
    assert [(item, ending(one)) for item, one in finished] == [(name, "died") for name in "abcd"]


def test_a_missed_time_limit_ends_the_run(native_fmu: Path) -> None:
    missing = partial(die, over_limit=True)
    given: list[Named] = [("a", missing), ("a", MOVE), ("b", MOVE), ("c", MOVE)]
    (item, missed), (none, last) = run_tasks(native_fmu, given, 60.0, name=str)
    assert (item, ending(missed), none) == ("a", "died", None)
    assert str(last.error) == "given up after crashes or exceeded limits in a; not run: b, c"
    ((only, _),) = run_tasks(native_fmu, given[:1], 60.0, name=str)
    assert only == "a", "nothing is left to be given up"


def test_an_fmu_that_opens_in_one_process_alone_runs_in_that(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[object] = []

    def licensed(*arguments: Any) -> IsolatedFmu:
        started.append(arguments)
        if len(started) > 1:
            raise FmuError("all licences are in use")
        return IsolatedFmu(*arguments)

    monkeypatch.setattr(tasks, "IsolatedFmu", licensed)
    given = [("a", own_process)] * 4
    finished = list(run_tasks(native_fmu, given, 60.0, name=str, jobs=2))
    assert [ending(outcome) for _, outcome in finished] == ["done"] * 4
    assert len(started) > 1


def test_an_fmu_that_cannot_be_used_is_reported_once(tmp_path: Path) -> None:
    given = [("a", MOVE), ("b", MOVE)]
    ((item, outcome),) = run_tasks(tmp_path / "none.fmu", given, 60.0, name=str)
    assert item is None
    assert "no such file" in str(outcome.error)


@pytest.mark.isolated
def test_processes_share_the_tasks_and_end_with_the_run(native_fmu: Path) -> None:
    given: list[Named] = [*((str(index), own_process) for index in range(6)), ("hangs", hang)]
    with closing(run_tasks(native_fmu, given, 60.0, name=str, jobs=2)) as finished:
        done = [next(finished) for _ in range(6)]
        began = monotonic()
    assert monotonic() - began < 10.0, "the task at work is ended"
    assert [item for item, _ in done] == [item for item, _ in given[:6]]
    assert len({outcome.value for _, outcome in done}) == 2


@pytest.mark.isolated
@pytest.mark.slow
@pytest.mark.parametrize(
    "faults",
    [
        {8: abort, 9: refused},
        {0: refused, 2: abort, 5: abort, 9: abort},
        {2: abort, 7: abort, 8: abort},
    ],
)
def test_outcomes_do_not_depend_on_jobs(native_fmu: Path, faults: dict[int, Task]) -> None:
    points = ["a", "b", "c1", "c2", "d", "e", "f", "g", "h", "k1", "k2"]
    given = [(point, faults.get(index, MOVE)) for index, point in enumerate(points)]
    alone, shared = (
        [
            (item, one.value, type(one.error), str(one.error))
            for item, one in run_tasks(native_fmu, given, 60.0, name=lambda of: of[0], jobs=jobs)
        ]
        for jobs in (1, 2)
    )
    assert shared == alone
