"""A C compiler for the driver: the system's for this machine, ziglang for Windows."""

import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

from slider_resonator.errors import HarnessError

SOURCES = Path(__file__).parent / "c"
ZIG = (sys.executable, "-m", "ziglang", "cc")
WINDOWS = ("-target", "x86_64-windows-gnu")
FLAGS = ("-std=c99", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Werror")
LIBRARIES = ("-ldl", "-lm", "-lpthread")


def native_compiler() -> list[str]:
    """Return the command of $CC, else the first C compiler there is, else ziglang.

    Raises HarnessError when there is none.
    """
    if chosen := os.environ.get("CC"):
        return shlex.split(chosen)
    for name in ("gcc", "clang", "cc"):
        if found := shutil.which(name):
            return [found]
    return zig_compiler()


def zig_compiler() -> list[str]:
    """Return the command of ziglang, which compiles for any platform; HarnessError without it."""
    if find_spec("ziglang") is None:
        raise HarnessError("no C compiler: ziglang is not installed; `make hosts` installs it")
    return list(ZIG)


def compiler_version(compiler: Sequence[str]) -> str:
    """Return name and version of a compiler."""
    if "ziglang" in compiler:
        answer = subprocess.run(
            [*compiler[:-1], "version"], capture_output=True, text=True, check=True
        )
        return f"zig {answer.stdout.strip()}"
    answer = subprocess.run([*compiler, "-dumpfullversion"], capture_output=True, text=True)
    return f"{Path(compiler[0]).name} {answer.stdout.strip()}"


def compile_program(
    compiler: Sequence[str], source: Path, program: Path, flags: Sequence[str] = ()
) -> Path:
    """Compile a C program against the headers of FMI 2.0 and return `program`.

    Raises HarnessError with the message of the compiler.
    """
    command = [*compiler, *FLAGS, *flags, *(f"-I{folder}" for folder in (fmi_headers(), SOURCES))]
    libraries = () if "-target" in compiler or sys.platform == "win32" else LIBRARIES
    command += [str(source.resolve()), "-o", str(program.resolve()), *libraries]
    # Not where ziglang may be installed below: it would not find the C library it has built before.
    folder = program.parent
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise HarnessError(f"{source.name} cannot be compiled: {done.stderr.strip()}")
    return program


def fmi_headers() -> Path:
    """Return the folder of the FMI headers that fmpy brings."""
    spec = find_spec("fmpy")
    if spec is None or spec.origin is None:
        raise HarnessError("no FMI headers: fmpy is not installed; `make setup` installs it")
    return Path(spec.origin).parent / "c-code"
