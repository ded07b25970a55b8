"""Tasks shared by several processes of an FMU, with the outcomes of one that runs them in turn."""

from collections.abc import Callable
from contextlib import closing
from functools import partial
from pathlib import Path
from time import monotonic
from typing import Any

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.tasks import run_tasks
from tests.harness.fmu.isolation import tasks_of_tests

pytestmark = pytest.mark.isolated

Task = Callable[[Instance], Any]
SLOW: Task = tasks_of_tests.own_process
MOVE: Task = partial(tasks_of_tests.position_after, time=0.01)


def outcomes(fmu: Path, given: list[tuple[str, Task]], jobs: int) -> list[tuple[object, ...]]:
    return [
        (item, one.value, type(one.error), str(one.error))
        for item, one in run_tasks(fmu, given, 60.0, name=lambda item: item[0], jobs=jobs)
    ]


def test_processes_share_the_tasks_and_end_with_the_run(native_fmu: Path) -> None:
    given = [*((str(index), SLOW) for index in range(6)), ("hangs", tasks_of_tests.hang)]
    with closing(run_tasks(native_fmu, given, 60.0, name=str, jobs=2)) as finished:
        done = [next(finished) for _ in range(6)]
        began = monotonic()
    assert monotonic() - began < 10.0, "the task at work is ended"
    assert [item for item, _ in done] == [item for item, _ in given[:6]]
    assert len({outcome.value for _, outcome in done}) == 2


ABORT, REFUSED = tasks_of_tests.abort, tasks_of_tests.refused


@pytest.mark.slow
@pytest.mark.parametrize(
    "faults",
    [
        {8: ABORT, 9: REFUSED},
        {0: REFUSED, 2: ABORT, 5: ABORT, 9: ABORT},
        {2: ABORT, 7: ABORT, 8: ABORT},
    ],
)
def test_outcomes_do_not_depend_on_jobs(native_fmu: Path, faults: dict[int, Task]) -> None:
    points = ["a", "b", "c1", "c2", "d", "e", "f", "g", "h", "k1", "k2"]
    given = [(point, faults.get(index, MOVE)) for index, point in enumerate(points)]
    assert outcomes(native_fmu, given, jobs=2) == outcomes(native_fmu, given, jobs=1)
