"""The process of an FMU, and how its end is reported."""

import tempfile
from collections.abc import Iterator
from contextlib import chdir
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from slider_resonator.errors import Refusal
from slider_resonator.fmu.isolation import process
from slider_resonator.fmu.isolation.crash_report import crash_report
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu
from slider_resonator.fmu.isolation.supervised import Ending, Supervised
from tests.harness.fmu.isolation import tasks_of_tests as tasks

pytestmark = pytest.mark.isolated


@pytest.fixture(scope="module")
def isolated(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[IsolatedFmu]:
    """A process for all tests after which it goes on.

    It is started in a folder with a module of the user, which must not be imported.
    """
    folder = tmp_path_factory.mktemp("present")
    (folder / "numpy.py").write_text("raise RuntimeError('a script of the user')")
    with chdir(folder):
        made = IsolatedFmu(native_fmu.resolve(), 60.0)
    with made:
        yield made


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder for temporary files of the test."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def test_an_error_keeps_its_type_and_the_process_goes_on(isolated: IsolatedFmu) -> None:
    with pytest.raises(Refusal, match="friction_faces = 7 refused"):
        isolated.run(tasks.refused)
    assert isolated.run(partial(tasks.position_after, time=0.01)) != 0.0


@pytest.mark.parametrize(
    ("task", "reason"), [(tasks.fail, "in fail\n"), (tasks.unpicklable, "pickle")]
)
def test_programming_error(isolated: IsolatedFmu, task: process.Task, reason: str) -> None:
    with pytest.raises(RuntimeError, match=reason):
        isolated.run(task)


def test_progress_arrives_before_the_result(isolated: IsolatedFmu) -> None:
    reported: list[tuple[str, float]] = []
    assert isolated.run(tasks.in_thirds, lambda *done: reported.append(done)) == "done"
    assert reported == [("third 0", 0.0), ("third 1", 1 / 3), ("third 2", 2 / 3)]


def test_an_interrupted_task_leaves_no_answer_to_the_next(native_fmu: Path) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    with IsolatedFmu(native_fmu, 60.0) as interrupted:
        with pytest.raises(KeyboardInterrupt):
            interrupted.run(tasks.in_thirds, interrupt)
        with pytest.raises(FmuDied, match="has been ended"):
            interrupted.run(tasks.disturb)


def test_process_without_listener_is_ended(
    native_fmu: Path, temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[Supervised] = []

    def supervised(*arguments: Any, **streams: Any) -> Supervised:
        started.append(Supervised(*arguments, **streams))
        return started[0]

    def refuse(**_: object) -> None:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(process, "Supervised", supervised)
    monkeypatch.setattr("threading.Thread", refuse)
    with pytest.raises(RuntimeError, match="new thread"):
        IsolatedFmu(native_fmu, 60.0)
    assert started[0].wait(0.0)
    assert not list(temporary.iterdir())


def test_the_fmu_shares_no_stream_with_the_harness(isolated: IsolatedFmu) -> None:
    assert isolated.run(tasks.disturb) == ""


def test_a_crash_of_fmi_3_names_its_function(native_3_fmu: Path) -> None:
    with (
        IsolatedFmu(native_3_fmu, 60.0) as isolated,
        pytest.raises(FmuDied, match=rf"^{native_3_fmu.name} crashed in fmi3DoStep: .* SIGSEGV"),
    ):
        isolated.run(tasks.crash_in_step_of_fmi_3)


def test_stopped_process_is_killed(
    native_fmu: Path, temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    isolated = IsolatedFmu(native_fmu, 1.0)
    monkeypatch.setattr(process, "GRACE", 0.5)
    with pytest.raises(FmuDied, match="within the time limit of 1 s"):
        isolated.run(tasks.stop)
    assert not list(temporary.iterdir())


def test_what_an_fmu_prints_is_limited(isolated: IsolatedFmu) -> None:
    with pytest.raises(RuntimeError, match="File too large"):
        isolated.run(tasks.print_much)
    assert isolated.run(partial(tasks.position_after, time=0.01)) != 0.0


TRACE = (
    "Fatal Python error: Aborted\n\nCurrent thread 0x1 (most recent call first):\n"
    '  File "/a/fmpy/fmi2.py", line 12 in doStep\n'
    '  File "/a/fmu/instance.py", line 107 in step_to\n'
    '  File "/a/fmu/run.py", line 219 in run\n'
)


def test_a_crash_names_the_call_and_the_signal() -> None:
    assert crash_report("a.fmu", "stepping\n", TRACE, Ending(-6), 60.0) == (
        "a.fmu crashed in fmi2DoStep: its process ended with SIGABRT; it printed: stepping",
        False,
    )


def test_a_missed_time_limit_is_reported_however_the_process_ended() -> None:
    trace = TRACE.replace("Fatal Python error: Aborted", "Timeout (0:01:00)!")
    expected = "no answer within the time limit of 60 s in fmi2DoStep: a.fmu was ended"
    for ending in (Ending(1), Ending(-11)):  # it crashed while it wrote the trace
        assert crash_report("a.fmu", "", trace, ending, 60.0) == (expected, True)
    without = expected.replace(" in fmi2DoStep", "")
    assert crash_report("a.fmu", "", "", Ending(None), 60.0) == (without, True)


def test_printed_text_is_not_taken_for_a_traceback() -> None:
    printed = TRACE.replace("Fatal Python error: Aborted", "Timeout (0:01:00)!")
    report, over_limit = crash_report("a.fmu", printed, "", Ending(1), 60.0)
    assert not over_limit
    assert report.startswith(
        "a.fmu crashed: its process ended with exit code 1; it printed: Timeout"
    )


def test_exceeded_limits() -> None:
    ending = Ending(excess="321 processes; must be at most 250")
    expected = "a.fmu was ended: it had 321 processes; must be at most 250"
    assert crash_report("a.fmu", "", "", ending, 60.0) == (expected, True)
