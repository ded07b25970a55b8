"""Tasks shared by several processes of an FMU, with the outcomes of one that runs them in turn."""

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
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.fmu.isolation.tasks import run_tasks
from tests.harness.fmu.isolation import tasks_of_tests

pytestmark = pytest.mark.isolated

Task = Callable[[Instance], Any]
SLOW: Task = tasks_of_tests.own_process
MOVE: Task = partial(tasks_of_tests.position_after, time=0.01)


@pytest.fixture(autouse=True)
def others_start_early(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tasks, "ALONE", 0.0)


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The times (s) at which processes were opened."""
    times: list[float] = []

    def isolated(*arguments: Any) -> IsolatedFmu:
        times.append(monotonic())
        return IsolatedFmu(*arguments)

    monkeypatch.setattr(tasks, "IsolatedFmu", isolated)
    return times


def outcomes(fmu: Path, given: list[tuple[str, Task]], jobs: int) -> list[tuple[object, ...]]:
    return [
        (item, one.value, type(one.error), str(one.error))
        for item, one in run_tasks(fmu, given, 60.0, name=lambda item: item[0], jobs=jobs)
    ]


def test_processes_share_the_tasks_and_keep_the_order(native_fmu: Path) -> None:
    given = [(str(index), SLOW) for index in range(6)]
    finished = list(run_tasks(native_fmu, given, 60.0, name=str, jobs=2))
    assert [item for item, _ in finished] == [item for item, _ in given]
    assert len({outcome.value for _, outcome in finished}) == 2


ABORT, REFUSED = tasks_of_tests.abort, tasks_of_tests.refused


@pytest.mark.slow
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


def test_a_short_run_starts_no_further_process(
    native_fmu: Path, opened: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tasks, "ALONE", 60.0)
    assert len(list(run_tasks(native_fmu, [("a", MOVE)] * 3, 60.0, name=str, jobs=4))) == 3
    assert len(opened) == 1


def test_an_fmu_that_runs_only_once_at_a_time_is_run_by_one_process(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[IsolatedFmu] = []

    def licensed(*arguments: Any) -> IsolatedFmu:
        if opened:
            raise FmuError("all licences are in use")
        opened.append(IsolatedFmu(*arguments))
        return opened[0]

    monkeypatch.setattr(tasks, "IsolatedFmu", licensed)
    finished = list(
        run_tasks(native_fmu, [(name, SLOW) for name in "abcd"], 60.0, name=str, jobs=2)
    )
    assert len({outcome.value for _, outcome in finished}) == 1


def test_a_run_that_is_left_ends_the_tasks_at_work(native_fmu: Path, opened: list[float]) -> None:
    given = [("a", SLOW)] * 4 + [("b", tasks_of_tests.hang)]
    with closing(run_tasks(native_fmu, given, 60.0, name=str, jobs=2)) as finished:
        for _ in range(4):
            next(finished)
        assert len(opened) == 2
        began = monotonic()
    assert monotonic() - began < 10.0
