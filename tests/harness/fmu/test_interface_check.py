"""What a description may say differently from the interface, and what not."""

import re
from pathlib import Path
from zipfile import ZipFile

from fmpy import read_model_description

from slider_resonator.fmu.interface_check import (
    archive_faults,
    description_faults,
    interface_problems,
)
from slider_resonator.fmu.opening import Fmu, open_fmu
from tests.fmus import both_fmus
from tests.harness.faulty_fmus import DESCRIPTION, altered, redescribed
from tests.harness.golden import assert_as_before

CHANGES = {
    "start": (b'start="3500.0"', b'start="3501.0"'),
    "min": (b'min="1e-12"', b'min="1e-11"'),
    "no max": (b'min="1" max="2"', b'min="1"'),
    "max": (b'max="0.01"', b'max="0.1"'),
    "nominal": (b'nominal="1e-08"', b'nominal="1e-06"'),
    "variability": (b'variability="tunable"', b'variability="fixed"'),
    "max of an output": (
        b'initial="calculated">\n      <Real unit="m/s"',
        b'initial="calculated">\n      <Real max="0.5" unit="m/s"',
    ),
    "initial": (b'initial="calculated"', b'initial="approx" '),
    "no time": (b'stopTime="0.2"', b'stopTime="0.0"'),
    "one large step": (b'stepSize="0.001"', b'stepSize="1.0"'),
    "no step": (b'stepSize="0.001"', b'stepSize="0"'),
    "linear": (
        b'dependencies="1 2 3 4 5" dependenciesKind="dependent ',
        b'dependencies="1 2 3 4 5" dependenciesKind="constant ',
    ),
    "needs a tool": (b'needsExecutionTool="false"', b'needsExecutionTool="true" '),
    "loop at the start": (
        b'index="28" dependencies="23" dependenciesKind="dependent"',
        b'index="28" dependencies="2 23" dependenciesKind="dependent dependent"',
    ),
    "display unit": (b'displayUnit="mm"', b'displayUnit="mile"'),
}
"""A place of the description and what to put there, by what is wrong then."""


@both_fmus
def test_the_builds_say_what_the_interface_says(fmu: Fmu) -> None:
    assert interface_problems(fmu.description) == []
    assert description_faults(fmu.description) == []


def test_each_change_is_one_fault(native_fmu: Path, tmp_path: Path) -> None:
    said = []
    for change, (old, new) in CHANGES.items():
        path = redescribed(native_fmu, tmp_path / "other.fmu", old, new)
        (fault,) = description_faults(read_model_description(str(path), validate=False))
        said.append(f"{change}: {fault}\n")
    assert_as_before("description_faults.txt", "".join(said))


def test_dependencies_are_neither_missing_nor_invented(native_fmu: Path) -> None:
    description = read_model_description(str(native_fmu))
    outputs = {unknown.variable.name: unknown for unknown in description.outputs}
    (phase,) = outputs["normal_force"].dependencies
    outputs["normal_force"].dependencies = []
    outputs["position"].dependencies = [phase]
    outputs["velocity"].dependencies = None
    description.outputs.remove(outputs["reversals"])
    assert description_faults(description) == [
        "position is declared to depend on phase, which does not act on it",
        "normal_force is declared independent of phase, which acts on it",
        "reversals is not among the outputs of ModelStructure",
    ]


def test_what_declares_no_dependencies_depends_on_all(native_fmu: Path, tmp_path: Path) -> None:
    def alter(name: str, content: bytes) -> bytes:
        declared = rb' dependencies="[^"]*" dependenciesKind="[^"]*"'
        return re.sub(declared, b"", content) if name == DESCRIPTION else content

    with open_fmu(altered(native_fmu, tmp_path / "other.fmu", alter)) as fmu:
        unknowns = [*fmu.description.outputs, *fmu.description.initialUnknowns]
        assert {one.dependencies for one in unknowns} == {None}
        assert description_faults(fmu.description) == []


def test_wrong_files_of_an_archive_are_named(native_fmu: Path, tmp_path: Path) -> None:
    description = read_model_description(str(native_fmu))
    with ZipFile(native_fmu) as archive:
        archive.extractall(tmp_path)
    assert [*archive_faults(tmp_path, description)] == []
    (tmp_path / "sources/component/component.h").unlink()
    (tmp_path / "sources/base/other.c").touch()
    (tmp_path / "binaries/win64").mkdir(exist_ok=True)
    (tmp_path / "binaries/win64/SliderResonator.dll").write_bytes(b"\x7fELF")
    assert len([*archive_faults(tmp_path, description)]) == 3
