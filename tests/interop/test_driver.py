"""The C driver: figures that do not come from fmpy, and its error messages."""

import subprocess
from pathlib import Path

import pytest

from studies.hosts.driver_host import native_driver
from studies.hosts.job import describe
from tests.native.toolchain import Binary, run, unpacked_binary

STEADY = {(0.0, 0.0, 1.0): 0.12666700, (0.4, 0.05, 1.0): 0.0986951, (0.4, 0.0, 3.0): -0.0362968}
"""Phase [rad], load [N], frequency ratio: steady velocity [m/s] of both degrees of freedom, found
by Taylor integration with located events."""


@pytest.fixture(scope="module")
def binary(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Binary:
    return unpacked_binary(native_fmu, tmp_path_factory.mktemp("driver"))


def drive(
    binary: Binary, commands: str, guid: str | None = None
) -> subprocess.CompletedProcess[str]:
    return run([native_driver(), binary.library, guid or binary.guid, "file:///"], commands)


def commands(native_fmu: Path, values: dict[str, float], *steps: str) -> str:
    references = describe(str(native_fmu)).references
    lines = [f"real {references[name]} {value!r}" for name, value in values.items()]
    return "\n".join([*lines, "initialize", *steps]) + "\n"


@pytest.mark.parametrize("inputs", STEADY)
def test_steady_velocity_in_a_process_without_python(
    native_fmu: Path, binary: Binary, inputs: tuple[float, float, float]
) -> None:
    values = dict(zip(("phase", "load", "frequency_ratio"), inputs, strict=True))
    reference = describe(str(native_fmu)).references["mean_velocity"]
    done = drive(binary, commands(native_fmu, values, "step 0.01 3000", f"get {reference}"))
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) == pytest.approx(STEADY[inputs], rel=1e-6)


@pytest.mark.parametrize(
    ("line", "code", "message"),
    [
        ("step -1.0 1", 1, "communicationStepSize = -1.0 refused"),
        ("real 999 1.0", 1, "999"),
        ("leap", 2, "leap is no command"),
        ("step 0.001 many", 2, "many is not a number"),
    ],
)
def test_errors_are_reported(
    native_fmu: Path, binary: Binary, line: str, code: int, message: str
) -> None:
    done = drive(binary, commands(native_fmu, {}, line))
    assert done.returncode == code
    assert message in done.stderr


def test_another_guid_makes_no_instance(binary: Binary) -> None:
    done = drive(binary, "", guid="another")
    assert done.returncode == 1
    assert "fmuGUID = 'another' refused" in done.stderr
