"""FMUs that are wrong in one way each, made from the native one."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import fmpy

SOURCE = Path(__file__).with_name("faulty_fmu.c")
DESCRIPTION = "modelDescription.xml"
SCENE = """
name = "{}"
title = "A few periods of table 1"

[run]
drive_periods = 2
steps_per_period = 8

[[expect]]
quantity = "position"
reference = "located_events"
relative = 1e-8
why = "the motion itself must agree"
"""


def scene(folder: Path, name: str = "short") -> Path:
    """Write a scene of two drive periods."""
    path = folder / f"{name}.toml"
    path.write_text(SCENE.format(name))
    return path


def altered(fmu: Path, out: Path, alter: Callable[[str, bytes], bytes | None]) -> Path:
    """Copy an FMU with each file replaced by what `alter` makes of it, or left out for None."""
    changed = 0
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(out, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            other = alter(name, content)
            changed += other != content
            if other is not None:
                new.writestr(name, other)
    assert changed, "the alteration must alter something"
    return out


def redescribed(fmu: Path, out: Path, old: bytes, new: bytes) -> Path:
    """Copy an FMU with one place in its description replaced."""

    def alter(name: str, content: bytes) -> bytes:
        return content.replace(old, new, 1) if name == DESCRIPTION else content

    return altered(fmu, out, alter)


def compiled(fmu: Path, out: Path, *defines: str) -> Path:
    """Copy an FMU with its binary for this platform replaced by `faulty_fmu.c`."""
    library = out.with_suffix(".library")
    command = [sys.executable, "-m", "ziglang", "cc", "-shared", "-fPIC", "-O1", "-std=gnu99"]
    subprocess.run(
        [*command, *(f"-D{define}" for define in defines), "-o", str(library), str(SOURCE)],
        check=True,
    )

    def alter(name: str, content: bytes) -> bytes:
        binary = name.startswith(f"binaries/{fmpy.platform}/")
        return library.read_bytes() if binary else content

    return altered(fmu, out, alter)
