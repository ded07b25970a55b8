"""A command that runs an FMU outlives it, whatever the FMU does in a call."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.harness import faulty_fmus
from tests.harness.calling import call, refused
from tests.processes import heed_interrupts

pytestmark = pytest.mark.isolated


@pytest.mark.parametrize("command", ["steady", "run"])
def test_a_hang_ends_at_the_time_limit(native_fmu: Path, tmp_path: Path, command: str) -> None:
    fmu = faulty_fmus.compiled(native_fmu, tmp_path / "faulty.fmu", "IN_STEP=LOOP", "VALUE=1.0")
    arguments = ["table_1"] if command == "run" else []
    reported = refused(command, fmu, *arguments, "--time-limit", "1")
    assert "no answer within the time limit of 1 s in fmi2DoStep" in reported


def test_a_crash_after_the_run_ends_with_2(native_fmu: Path, tmp_path: Path) -> None:
    fmu = faulty_fmus.compiled(native_fmu, tmp_path / "faulty.fmu", "IN_FREE=CRASH")
    assert "crashed in fmi2Terminate or fmi2FreeInstance" in refused("run", fmu, "table_1")


@pytest.mark.parametrize("command", ["steady", "blocking"])
def test_a_drive_frequency_of_zero_is_an_error_of_the_fmu(
    native_fmu: Path, tmp_path: Path, command: str
) -> None:
    fmu = faulty_fmus.compiled(native_fmu, tmp_path / "still.fmu", "VALUE=0.0")
    result = call(command, fmu)
    assert result.exit_code == 2
    reported = (
        "still.fmu reports drive_frequency = 0.0: must be a finite number of at least 1e-06 rad/s"
    )
    assert result.stderr == f"error: {reported}\n"


@pytest.mark.skipif(sys.platform == "win32", reason="no signals to end a process with")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_an_ended_command_ends_the_fmu_and_leaves_nothing(
    native_fmu: Path, tmp_path: Path, number: signal.Signals
) -> None:
    fmu = faulty_fmus.compiled(native_fmu, tmp_path / "loop.fmu", "IN_STEP=LOOP")
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    command = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "slider_resonator",
            "run",
            str(fmu),
            "table_1",
            "--time-limit",
            "30",
        ],
        env={**os.environ, "TMPDIR": str(temporary)},
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=heed_interrupts,
    )
    while not list(temporary.glob("*/*/unpacked/binaries")):
        assert command.poll() is None
        time.sleep(0.1)
    time.sleep(0.5)  # until it is in the loop
    command.send_signal(number)
    _, message = command.communicate(timeout=60.0)
    assert command.returncode == 130
    assert message.strip() == "interrupted"
    assert not list(temporary.iterdir())
    running = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True)
    assert str(fmu) not in running.stdout


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_a_killed_command_takes_the_fmu_and_its_folder_along(
    native_fmu: Path, tmp_path: Path
) -> None:
    fmu = faulty_fmus.compiled(native_fmu, tmp_path / "loop.fmu", "IN_STEP=LOOP")
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with subprocess.Popen(
        [sys.executable, "-m", "slider_resonator", "run", str(fmu), "table_1"],
        env={**os.environ, "TMPDIR": str(temporary)},
    ) as command:
        wait_until(lambda: bool(list(temporary.glob("*/*/unpacked/binaries"))))
        command.kill()
    wait_until(lambda: not list(temporary.iterdir()))
    running = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True, check=True)
    assert str(fmu) not in running.stdout


def wait_until(condition: Callable[[], bool]) -> None:
    for _ in range(600):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("it takes too long")
