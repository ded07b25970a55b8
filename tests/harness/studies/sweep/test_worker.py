from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager
from pathlib import Path

import pytest

from slider_resonator.fmu.drive import Instance, instantiate
from slider_resonator.fmu.opening import Fmu
from slider_resonator.studies.sweep import worker
from slider_resonator.studies.sweep.measures import Run, Task

TASK = Task(("friction_coefficient",), (), ("steady_velocity",), 20, Run(1, 1, 0))


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    yield
    worker.close()


def opened(monkeypatch: pytest.MonkeyPatch) -> list[Fmu]:
    """A list that grows by every FMU of which the worker makes an instance."""
    made: list[Fmu] = []

    def instantiated(fmu: Fmu) -> AbstractContextManager[Instance]:
        made.append(fmu)
        return instantiate(fmu)

    monkeypatch.setattr(worker, "instantiate", instantiated)
    return made


def test_an_instance_is_reused_from_chunk_to_chunk(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = opened(monkeypatch)
    worker.register("digest", native_fmu)
    rows, seconds = worker.run_chunk(TASK, "digest", [(0, (0.1,)), (1, (0.2,))])
    rows += worker.run_chunk(TASK, "digest", [(2, (0.1,))])[0]
    assert len(made) == 1
    assert seconds > 0.0
    assert rows[0][1] == rows[2][1] != rows[1][1]
    folder = made[0].folder
    worker.close()
    assert not folder.exists(), "what was unpacked is removed"


def test_a_thread_whose_instance_another_has_freed_makes_a_new_one(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As on a cluster, where the end of a sweep is told in another thread than the points."""
    made = opened(monkeypatch)
    worker.register("digest", native_fmu)
    with ThreadPoolExecutor(1) as thread:
        before = thread.submit(worker.run_chunk, TASK, "digest", [(0, (0.1,))]).result()
        worker.close()
        after = thread.submit(worker.run_chunk, TASK, "digest", [(0, (0.1,))]).result()
    assert len(made) == 2, "an instance that has been freed is not called again"
    assert before[0] == after[0]


def test_a_point_that_fails_is_a_row_with_its_error_and_the_next_is_sound(native_fmu: Path) -> None:
    worker.register("digest", native_fmu)
    points = [(0, (-1.0,)), (1, (0.1,))]
    (failed, sound), _ = worker.run_chunk(TASK, "digest", points)
    assert failed[:2] == (0, [None, None])
    assert "friction_coefficient = -1" in str(failed[2])
    assert sound[1][1] == "steady"


def test_the_error_of_a_missing_file_does_not_show_where_this_worker_has_it(tmp_path: Path) -> None:
    worker.register("elsewhere", tmp_path / "my.fmu")
    ((_, cells, error),), _ = worker.run_chunk(TASK, "elsewhere", [(0, (0.1,))])
    assert cells == [None, None]
    assert error == "my.fmu: no such file"


def test_a_worker_without_the_fmu_says_so() -> None:
    ((_, _, error),), _ = worker.run_chunk(TASK, "unheard of", [(0, (0.1,))])
    assert error == "this worker has not been given the FMU"
