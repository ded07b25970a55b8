"""The C driver: a process with the driver and the FMU's binary only."""

import atexit
import platform
import shutil
import subprocess
import tempfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path

from studies.hosts.compiler import SOURCES, compile_program, native_compiler
from studies.hosts.job import Job, Rows, describe, serve

BINARY = {
    "Linux": ("linux64", ".so"),
    "Darwin": ("darwin64", ".dylib"),
    "Windows": ("win64", ".dll"),
}


SCRIPT, PRINTED, ERRORS = "script", "printed", "errors"
"""Files of a driver's standard input, output and error."""

Execute = Callable[[Sequence[str], Path], str]
"""Runs a driver on these files of a folder; returns how it ended, such as "ended with 0"."""


def run(job: Job) -> Rows:
    """Step the FMU in a driver compiled for this machine."""
    return run_natively(Path(job.fmu), commands(job))


def run_natively(fmu: Path, script: str, execute: Execute | None = None) -> Rows:
    """Run a script in the driver for this machine, as `run_driver`."""
    command, binary = [str(native_driver())], BINARY[platform.system()]
    return run_driver(fmu, script, command, *binary, str, execute or execute_directly)


def execute_directly(command: Sequence[str], folder: Path) -> str:
    """Run a driver without a time limit."""
    # Files, not pipes: Wine's server keeps what it inherits open long after the driver's end.
    with (
        (folder / SCRIPT).open() as stdin,
        (folder / PRINTED).open("w") as stdout,
        (folder / ERRORS).open("w") as stderr,
    ):
        done = subprocess.run(command, stdin=stdin, stdout=stdout, stderr=stderr, check=False)
    return f"ended with {done.returncode}"


def run_driver(
    fmu: Path,
    script: str,
    command: Sequence[str],
    folder: str,
    suffix: str,
    path_for_driver: Callable[[Path], str],
    execute: Execute,
) -> Rows:
    """Run a script in `command`, a driver, on the FMU's binary; return the numbers it prints.

    `path_for_driver` returns the driver's name of a file, `execute` how the driver ended. Raises
    RuntimeError with the driver's messages.
    """
    description = describe(str(fmu))
    with tempfile.TemporaryDirectory(prefix="slider-resonator-") as name:
        unpacked = Path(name)
        with zipfile.ZipFile(fmu) as archive:
            archive.extractall(unpacked)
        library = unpacked / "binaries" / folder / f"{description.identifier}{suffix}"
        arguments = [path_for_driver(library), description.guid, (unpacked / "resources").as_uri()]
        (unpacked / SCRIPT).write_text(script)
        ended = execute([*command, *arguments], unpacked)
        if ended != "ended with 0":
            problem = (unpacked / ERRORS).read_text(errors="replace").strip()
            raise RuntimeError(f"the driver {ended}: {problem}")
        return [
            [float(value) for value in line.split()]
            for line in (unpacked / PRINTED).read_text().splitlines()
        ]


def commands(job: Job) -> str:
    """Return the job as a script for the driver."""
    references = describe(job.fmu).references
    lines = initialised(references, job.first())
    get = " ".join(["get", *(str(references[name]) for name in job.outputs)])
    for index in range(job.steps):
        for name, values in job.inputs.items():
            lines.append(f"real {references[name]} {values[index]!r}")
        lines += [f"step {job.step!r} 1", get]
    return "\n".join(lines) + "\n"


def initialised(references: Mapping[str, int], values: Mapping[str, float]) -> list[str]:
    """Return the lines of a script that set values, by name, and initialise."""
    lines = [
        f"{'integer' if isinstance(value, int) else 'real'} {references[name]} {value!r}"
        for name, value in values.items()
    ]
    return [*lines, "initialize"]


@cache
def native_driver() -> Path:
    """Compile the driver, once per process, and return it."""
    return compile_program(native_compiler(), SOURCES / "driver.c", temporary_folder() / "driver")


def temporary_folder() -> Path:
    """Return a new folder that is removed when this process ends."""
    folder = Path(tempfile.mkdtemp(prefix="slider-resonator-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


if __name__ == "__main__":
    serve(run)
