from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu
from slider_resonator.sweeping import cluster, worker
from slider_resonator.sweeping.measures import Run, Task
from slider_resonator.sweeping.worker import ChunkRunner, measure_point
from tests.harness.faulty_fmus import compiled

TASK = Task(("friction_coefficient",), (), ("steady_velocity",), 20, Run(1, 1, 0))
SOUND = [(0, (0.1,))]


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[IsolatedFmu]:
    """All processes that are started."""
    started: list[IsolatedFmu] = []

    def start(fmu: Path, time_limit: float) -> IsolatedFmu:
        started.append(IsolatedFmu(fmu, time_limit))
        return started[-1]

    monkeypatch.setattr(worker, "IsolatedFmu", start)
    return started


@pytest.fixture
def runner(native_fmu: Path, made: list[IsolatedFmu]) -> Iterator[ChunkRunner]:
    created = ChunkRunner(native_fmu)
    yield created
    created.end()


def test_a_process_is_reused_from_chunk_to_chunk(
    runner: ChunkRunner, made: list[IsolatedFmu]
) -> None:
    rows, seconds = runner.run(TASK, [(0, (0.1,)), (1, (0.2,))])
    rows += runner.run(TASK, [(2, (0.1,))])[0]
    assert len(made) == 1
    assert seconds > 0.0
    assert rows[0][1] == rows[2][1] != rows[1][1]


def test_a_thread_whose_process_another_has_ended_starts_a_new_one(
    runner: ChunkRunner, made: list[IsolatedFmu]
) -> None:
    """As on a cluster, where the end of a sweep comes in another thread than the points."""
    with ThreadPoolExecutor(1) as thread:
        before = thread.submit(runner.run, TASK, SOUND).result()
        runner.end()
        after = thread.submit(runner.run, TASK, SOUND).result()
    assert len(made) == 2
    assert before[0] == after[0]


def test_a_crash_is_raised_and_the_next_chunk_gets_a_new_process(
    native_fmu: Path, tmp_path: Path, made: list[IsolatedFmu]
) -> None:
    runner = ChunkRunner(compiled(native_fmu, tmp_path / "f.fmu", "IN_STEP=CRASH", "VALUE=1.0"))
    for _ in range(2):
        with pytest.raises(FmuDied, match="crashed in fmi2DoStep"):
            runner.run(TASK, SOUND)
    assert len(made) == 2
    runner.end()


def test_a_point_that_fails_is_a_row_with_its_error_and_the_next_is_sound(
    instance: Instance,
) -> None:
    failed, _ = measure_point(instance, TASK, (0, (-1.0,)))
    sound, _ = measure_point(instance, TASK, (1, (0.1,)))
    assert failed[:2] == (0, [None, None])
    assert "friction_coefficient = -1" in str(failed[2])
    assert sound[1][1] == "steady"


def test_the_error_of_a_missing_file_hides_the_folder_of_the_worker(tmp_path: Path) -> None:
    ((_, cells, error),), _ = ChunkRunner(tmp_path / "my.fmu").run(TASK, SOUND)
    assert cells == [None, None]
    assert error == "my.fmu: no such file"


def test_a_worker_without_the_fmu_is_reported() -> None:
    ((_, _, error),), _ = cluster.run_chunk(TASK, "unheard of", SOUND)
    assert error == "this worker has not been given the FMU"


def test_a_point_that_takes_too_long_is_a_row_and_the_others_go_on(
    native_fmu: Path, tmp_path: Path
) -> None:
    """Endless at a coefficient of 0.5, which is the first value that is read back."""
    slow = "static int set; if (set) { LOOP } set = 1;"
    fmu = compiled(native_fmu, tmp_path / "slow.fmu", f"IN_STEP={slow}", "VALUE=1.0")
    task = Task(("friction_coefficient",), (), ("velocity.rms",), 20, Run(1, 1, 0))
    runner = ChunkRunner(fmu, time_limit=1.0)
    rows, _ = runner.run(task, [(0, (0.1,)), (1, (0.2,)), (2, (0.3,))])
    runner.end()
    assert [row[2] is None for row in rows] == [True, False, True], rows
    assert "no answer within the time limit of 1 s in fmi2DoStep" in str(rows[1][2])
