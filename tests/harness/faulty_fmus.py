"""FMUs that are wrong in one way each, made from the native one."""

import re
import subprocess
import sys
import zipfile
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy

from slider_resonator.device.interface import FIRST, VARIABLES

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


def without_later_variables(fmu: Path, out: Path) -> Path:
    """Copy an FMU without the variables that came after the first version of the interface."""

    def alter(name: str, content: bytes) -> bytes:
        if name != DESCRIPTION:
            return content
        root = ET.fromstring(content)
        variables = root.find("ModelVariables")
        assert variables is not None
        places: dict[str, str] = {}
        for index, variable in enumerate(list(variables), start=1):
            if VARIABLES[variable.attrib["name"]].since == FIRST:
                places[str(index)] = str(len(places) + 1)
            else:
                variables.remove(variable)
        for parent in root.iterfind("ModelStructure/*"):
            for unknown in list(parent):
                if unknown.attrib["index"] not in places:
                    parent.remove(unknown)
                    continue
                unknown.set("index", places[unknown.attrib["index"]])
                kept = [i for i in unknown.attrib.get("dependencies", "").split() if i in places]
                unknown.set("dependencies", " ".join(places[index] for index in kept))
                unknown.attrib.pop("dependenciesKind", None)
        root.set("description", "without later variables")
        return ET.tostring(root)

    return altered(fmu, out, alter)


def other_friction(python_fmu: Path, out: Path) -> Path:
    """Copy the Python FMU with 0.1 % more friction than its description says.

    Its modules have other names, so that one process can run both.
    """
    row = b"tunable friction_coefficient 1, start 0.1"
    altered = 0
    with zipfile.ZipFile(python_fmu) as old, zipfile.ZipFile(out, "w") as new:
        (digest,) = set(re.findall(r"slider_component_([0-9a-f]{12})/", " ".join(old.namelist())))
        for name in old.namelist():
            content = old.read(name).replace(digest.encode(), digest[::-1].encode())
            altered += content.count(row)
            new.writestr(name.replace(digest, digest[::-1]), content.replace(row, row + b"001"))
    assert altered == 1, "the table of variables must have the row that is altered"
    return out


def cut(fmu: Path, out: Path) -> Path:
    """Copy the first half of an FMU: an archive whose end was lost on the way."""
    content = fmu.read_bytes()
    out.write_bytes(content[: len(content) // 2])
    return out


def flipped(fmu: Path, out: Path) -> Path:
    """Copy an FMU with nothing but zeros in 4 kB of one of its files."""
    content = bytearray(fmu.read_bytes())
    content[40:4000] = bytes(3960)
    out.write_bytes(content)
    return out


def without_binaries(fmu: Path, out: Path) -> Path:
    """Copy an FMU without its binaries."""

    def alter(name: str, content: bytes) -> bytes | None:
        return None if name.startswith("binaries/") else content

    return altered(fmu, out, alter)


def shared_library(source: Path, fmu: Path, *arguments: str) -> bytes:
    """Compile a source for this platform, beside the FMU that it is for."""
    library = fmu.with_suffix(".library")
    command = [sys.executable, "-m", "ziglang", "cc", "-shared", "-fPIC", "-O1", "-std=gnu99"]
    subprocess.run([*command, "-o", str(library), str(source), *arguments], check=True)
    return library.read_bytes()


def compiled(fmu: Path, out: Path, *defines: str) -> Path:
    """Copy an FMU with its binary for this platform replaced by `faulty_fmu.c`."""
    library = shared_library(SOURCE, out, *(f"-D{define}" for define in defines))

    def alter(name: str, content: bytes) -> bytes:
        return library if name.startswith(f"binaries/{fmpy.platform}/") else content

    return altered(fmu, out, alter)


DESCRIBED: Mapping[str, tuple[bytes, bytes, str]] = {
    "wrong GUID": (b'guid="', b'guid="0', "GUID"),
    "missing variable": (b'name="load"', b'name="lode"', "input load is missing"),
    "another unit": (b'unit="N" displayUnit="mN"', b'unit="m"', "load has unit m, must be N"),
    "unit of another size": (
        b'<BaseUnit kg="1" m="1" s="-2" />',
        b'<BaseUnit kg="1" m="1" s="-2" factor="1000.0" />',
        "unit N is defined with factor 1000.0, must be 1",
    ),
    "Real for an Integer": (
        b'<Integer min="1" max="2" start="2" />',
        b'<Real unit="1" min="1" max="2" start="2" />',
        "friction_faces is of type Real, must be Integer",
    ),
    "truncated structure": (b"</ModelStructure>", b"", "modelDescription.xml cannot be read"),
    "truncated XML": (b"</fmiModelDescription>", b"", "modelDescription.xml cannot be read"),
}
"""What is wrong with a description: what to replace by what, and the cause to be named."""

BROKEN: Mapping[str, tuple[Callable[[Path, Path], Path], str]] = {
    "corrupt zip, cut": (cut, "no zip archive"),
    "corrupt zip, flipped": (flipped, "cannot be "),
    "missing binary": (without_binaries, "no binary for "),
    **{
        name: (partial(redescribed, old=old, new=new), cause)
        for name, (old, new, cause) in DESCRIBED.items()
    },
    "crash in doStep": (
        lambda fmu, out: compiled(fmu, out, "IN_STEP=CRASH"),
        "crashed in fmi2DoStep",
    ),
    "endless loop in doStep": (
        lambda fmu, out: compiled(fmu, out, "IN_STEP=LOOP"),
        "no answer within the time limit of 2 s in fmi2DoStep",
    ),
}
"""How an FMU is broken, what makes it so, and the cause that a message must name."""
