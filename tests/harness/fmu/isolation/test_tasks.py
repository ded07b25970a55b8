"""Which tasks are run, and how often, where an FMU dies; the processes are tested beside this."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.fmu.isolation.tasks import (
    Finished,
    LocalProcesses,
    run_all_tasks,
    run_tasks,
)
from tests.harness.fmu.isolation import tasks_of_tests as tasks

MOVE = partial(tasks.position_after, time=0.01)


Named = tuple[str, Callable[[Instance], Any]]


CLOCK = [0.0]
"""The time (s) of a test that does not wait."""


def die(instance: Instance, seconds: float = 0.0, over_limit: bool = False) -> None:
    CLOCK[0] += seconds
    raise FmuDied("as a process of its own would have", over_limit=over_limit)


def outcome(finished: Finished[str]) -> str:
    if finished.error is None:
        return "done"
    return "died" if isinstance(finished.error, FmuDied) else "error"


def test_a_task_that_fails_leaves_the_others_alone(native_fmu: Path) -> None:
    given: list[Named] = [("a", MOVE), ("b", tasks.refused), ("c", die), ("d", MOVE)]
    working: list[str] = []
    finished = list(run_tasks(native_fmu, given, 60.0, name=str, meanwhile=working.append))
    assert [one.item for one in finished] == working == ["a", "b", "c", "d"]
    assert [outcome(one) for one in finished] == ["done", "error", "died", "done"]
    assert finished[0].result == finished[3].result


def test_tasks_of_one_name_are_left_out_after_a_crash(native_fmu: Path) -> None:
    given: list[Named] = [("a", die), ("a", MOVE), ("b", MOVE)]
    finished = list(run_tasks(native_fmu, given, 60.0, name=str))
    assert [(one.item, outcome(one)) for one in finished] == [("a", "died"), ("b", "done")]


def test_an_fmu_that_keeps_crashing_is_given_up_by_default(native_fmu: Path) -> None:
    given = [(name, die) for name in "abcd"]
    *_, last = run_tasks(native_fmu, given, 60.0, name=str)
    assert last.item is None
    assert str(last.error) == "given up after 3 crashes or exceeded limits; not run: d"


def test_all_tasks_are_run_however_many_crash(native_fmu: Path) -> None:
    given = [(name, die) for name in "abcd"]
    with LocalProcesses(native_fmu, 60.0) as processes:
        finished = list(run_all_tasks(processes, given, outcomes=(FmuDied,)))
    assert [item for item, _, error in finished if isinstance(error, FmuDied)] == list("abcd")


def test_a_missed_time_limit_ends_the_run(native_fmu: Path) -> None:
    missing = partial(die, over_limit=True)
    given: list[Named] = [("a", missing), ("a", MOVE), ("b", MOVE), ("c", MOVE)]
    missed, last = run_tasks(native_fmu, given, 60.0, name=str)
    assert (missed.item, outcome(missed)) == ("a", "died")
    assert last.item is None
    assert str(last.error) == "given up after 1 crash or exceeded limit; not run: b, c"


def test_crashes_that_took_the_time_limit_end_the_run(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(f"{run_tasks.__module__}.monotonic", lambda: CLOCK[0])
    slow: Named = ("a", partial(die, seconds=0.9))
    given = [slow, ("b", slow[1]), ("c", slow[1])]
    *died, last = run_tasks(native_fmu, given, 1.5, name=str)
    assert [(one.item, outcome(one)) for one in died] == [("a", "died"), ("b", "died")]
    assert str(last.error) == "given up after 2 crashes or exceeded limits; not run: c"


def test_an_fmu_that_cannot_be_used_is_reported_once(tmp_path: Path) -> None:
    (finished,) = run_tasks(tmp_path / "none.fmu", [("a", MOVE), ("b", MOVE)], 60.0, name=str)
    assert finished.item is None
    assert "no such file" in str(finished.error)
