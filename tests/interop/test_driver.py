"""The error messages of the C driver."""

import subprocess
from pathlib import Path

import pytest

from studies.hosts.driver_host import native_driver
from tests.native.toolchain import Binary, run, unpacked_binary


@pytest.fixture(scope="module")
def binary(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Binary:
    return unpacked_binary(native_fmu, tmp_path_factory.mktemp("driver"))


def drive(
    binary: Binary, commands: str, guid: str | None = None
) -> subprocess.CompletedProcess[str]:
    return run([native_driver(), binary.library, guid or binary.guid, "file:///"], commands)


@pytest.mark.parametrize(
    ("line", "code", "message"),
    [
        ("step -1.0 1", 1, "communicationStepSize = -1.0 refused"),
        ("real 999 1.0", 1, "999"),
        ("leap", 2, "leap is no command"),
        ("step 0.001 many", 2, "many is not a number"),
    ],
)
def test_errors_are_reported(binary: Binary, line: str, code: int, message: str) -> None:
    done = drive(binary, f"initialize\n{line}\n")
    assert done.returncode == code
    assert message in done.stderr


def test_another_guid_makes_no_instance(binary: Binary) -> None:
    done = drive(binary, "", guid="another")
    assert done.returncode == 1
    assert "fmuGUID = 'another' refused" in done.stderr
