from __future__ import annotations

import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.output.progress import no_progress
from studies.mutants.archive import PythonFmu, read_python_fmu
from studies.mutants.attempt import Attempt, Attempted, Bench
from studies.mutants.points import scene_points
from studies.mutants.reach import noting_source
from studies.mutants.trial_client import TrialServers, trial_servers
from tests.harness import faulty_fmus
from tests.processes import has_ended

AT_A_LEG = "    turn = tau / LONGEST_ARC * arc\n"


@pytest.fixture(scope="module")
def fmu(python_fmu: Path) -> PythonFmu:
    return read_python_fmu(python_fmu)


@pytest.fixture(scope="module")
def servers(python_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[TrialServers]:
    folder = tmp_path_factory.mktemp("servers")
    files = [faulty_fmus.scene(folder, name) for name in ("first", "second")]
    points = scene_points(files, no_progress)
    bench = Bench(python_fmu.resolve(), points, [0.0] * len(points), 1.0)
    with trial_servers(bench, 1, folder) as started:
        yield started


def tried(servers: TrialServers, fmu: PythonFmu, file: str, old: str, new: str) -> Attempted:
    """Return what becomes of the FMU with one text in a module replaced."""
    text = fmu.modules[file]
    assert text.count(old) >= 1
    changed = {fmu.path_of(file): text.replace(old, new, 1).encode()}
    return servers.attempt(Attempt(changed, [1, 0]))


def test_the_original_passes_also_after_faulty_ones(servers: TrialServers, fmu: PythonFmu) -> None:
    faulty = tried(servers, fmu, "device.py", "drive = force", "drive = 1.01 * force")
    assert faulty.rejection is not None
    assert (faulty.rejection.scene, faulty.rejection.quantity) == ("second", "position")
    assert "off by" in faulty.rejection.reason
    assert faulty.at == 1
    original = servers.attempt(Attempt({}, [0, 1]))
    assert original.rejection is None, original
    assert 0.0 < original.cpu_time < 2.0


@pytest.mark.parametrize(
    ("new", "reason"),
    [
        ("while True: pass", "no answer within the"),
        ("import time; time.sleep(600)", "no answer within the time limit"),
        ("import ctypes; ctypes.string_at(0)", "the FMU crashed: SIGSEGV"),
        ("import os; os._exit(0)", "the FMU crashed: exit code 0"),
        ("raise RuntimeError('broken')", "broken"),
        ("bytearray(2**33)", "MemoryError"),
    ],
)
def test_hangs_crashes_and_errors_reject(
    servers: TrialServers, fmu: PythonFmu, new: str, reason: str
) -> None:
    found = tried(servers, fmu, "events.py", AT_A_LEG, f"{AT_A_LEG}    {new}\n")
    assert found.rejection is not None
    assert reason in found.rejection.reason
    assert (found.rejection.scene, found.rejection.quantity, found.at) == ("second", "", 1)


def test_what_cannot_be_loaded_is_rejected_before_any_scene(
    servers: TrialServers, fmu: PythonFmu
) -> None:
    found = tried(servers, fmu, "clock.py", "class Clock", "1 / 0\nclass Clock")
    assert found.rejection is not None
    assert (found.rejection.scene, found.at) == ("", None)


def test_noting_modules_tell_what_each_point_executes(
    servers: TrialServers, fmu: PythonFmu
) -> None:
    text = fmu.modules["events.py"]
    line = text[: text.index(AT_A_LEG)].count("\n") + 1
    changed = {fmu.path_of("events.py"): noting_source(text).encode()}
    found = servers.attempt(Attempt(changed, [0, 1], noting=True))
    assert found.rejection is None
    assert set(found.executed) == {0, 1}
    for places in found.executed.values():
        assert ("events.py", line) in places
        assert {file for file, _ in places} == {"events.py"}


def test_an_attempt_at_work_ends_with_its_server(
    python_fmu: Path, fmu: PythonFmu, tmp_path: Path
) -> None:
    points = scene_points([faulty_fmus.scene(tmp_path)], no_progress)
    bench = Bench(python_fmu.resolve(), points * 2, [0.0, 0.0], 60.0)
    noted = tmp_path / "process"
    note = f"import os, pathlib; pathlib.Path({str(noted)!r}).write_text(str(os.getpid()))"
    hang = f"{AT_A_LEG}    {note}; import time; time.sleep(600)\n"
    with ThreadPoolExecutor(1) as pool, trial_servers(bench, 1, tmp_path) as started:
        hanging = pool.submit(tried, started, fmu, "events.py", AT_A_LEG, hang)
        while not (noted.exists() and noted.read_text()):
            assert not hanging.done(), hanging.result()
            time.sleep(0.05)
    with pytest.raises(HarnessError, match="has ended"):
        hanging.result()
    assert has_ended(int(noted.read_text()))
