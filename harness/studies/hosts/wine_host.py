"""The C driver for Windows, cross-compiled, with the FMU's Windows binary under Wine."""

import fcntl
import os
import subprocess
from contextlib import suppress
from functools import cache
from pathlib import Path, PureWindowsPath

from studies.hosts.compiler import SOURCES, WINDOWS, compile_program, zig_compiler
from studies.hosts.driver_host import (
    BINARY,
    commands,
    execute_directly,
    run_driver,
    temporary_folder,
)
from studies.hosts.job import Job, Rows, serve

LIKE_THE_FMU = ("-g0", "-s")
"""The options of the FMU's build: with others ziglang would first build another C library."""


def run(job: Job) -> Rows:
    """Step the FMU's Windows binary."""
    command = ["wine", str(windows_driver())]
    fmu, script = Path(job.fmu), commands(job)
    return run_driver(fmu, script, command, *BINARY["Windows"], seen_from_windows, execute_directly)


def seen_from_windows(path: Path) -> str:
    """Return an absolute path as Wine shows it, on drive Z."""
    return str(PureWindowsPath(f"Z:{path.as_posix()}"))


@cache
def windows_driver() -> Path:
    """Cross-compile the driver, once per process, and return it."""
    compiler = [*zig_compiler(), *WINDOWS]
    program = temporary_folder() / "driver.exe"
    return compile_program(compiler, SOURCES / "driver.c", program, LIKE_THE_FMU)


def make_prefix() -> None:
    """Make the folder of Wine where there is none; two at once would leave it without libraries."""
    prefix = Path(os.environ.get("WINEPREFIX") or Path.home() / ".wine")
    parent = os.open(prefix.parent, os.O_RDONLY)
    try:
        fcntl.flock(parent, fcntl.LOCK_EX)
        if not (prefix / "system.reg").exists():
            subprocess.run(["wine", "wineboot", "--init"], check=False, timeout=120.0)
            subprocess.run(["wineserver", "-w"], check=False, timeout=120.0)
    finally:
        os.close(parent)


if __name__ == "__main__":
    os.environ.setdefault("WINEDEBUG", "-all")
    # Without these a new Wine prefix asks to download Mono and Gecko.
    os.environ.setdefault("WINEDLLOVERRIDES", "mscoree=;mshtml=")
    make_prefix()
    serve(run)
    # The server is killed after this process; it saves what Wine needs when it ends by itself.
    with suppress(OSError, subprocess.TimeoutExpired):
        subprocess.run(["wineserver", "-w"], check=False, timeout=30.0)
