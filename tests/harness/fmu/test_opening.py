"""What can be opened, and what a description may say differently from the interface."""

import re
import zipfile
from math import pi
from pathlib import Path

import pytest
from fmpy import extract, read_model_description
from fmpy.model_description import BaseUnit, DisplayUnit, Unit

from slider_resonator.device.interface import INPUTS, OUTPUTS, PARAMETERS
from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu import limits, opening
from slider_resonator.fmu.interface_check import (
    DIMENSIONS,
    archive_faults,
    description_faults,
    interface_problems,
    unit_problems,
)
from slider_resonator.fmu.opening import Fmu, open_fmu
from studies.mutants.archive import files_in
from tests.fmus import every_slider
from tests.harness import faulty_fmus
from tests.harness.faulty_fmus import altered, redescribed
from tests.harness.golden import assert_as_before

XML = "modelDescription.xml"


def refusal(path: Path) -> str:
    with pytest.raises(FmuError) as caught, open_fmu(path):
        pass
    return str(caught.value)


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({"readme.txt": "hello"}, "no item named 'modelDescription.xml'"),
        ({XML: "<fmiModelDescription"}, "cannot read"),
        ({XML: '<fmiModelDescription fmiVersion="1.0"/>'}, "FMI version 1.0; must be 2.0 or 3.0"),
        ({XML: '<fmiModelDescription fmiVersion="3.1"/>'}, "FMI version 3.1; must be 2.0 or 3.0"),
        ({"a": "", "b": "", "c": ""}, "3 files; must be at most 2"),
        ({"a": " " * 3 * 2**20}, "3 MiB unpacked; must be at most 1 MiB (--max-unpacked)"),
    ],
)
def test_an_archive_that_is_no_fmu_is_refused_unopened(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, files: dict[str, str], said: str
) -> None:
    monkeypatch.setenv(limits.UNPACKED, "1")
    monkeypatch.setattr(opening, "MAX_ENTRIES", 2)
    with zipfile.ZipFile(tmp_path / "other.fmu", "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in files.items():
            made.writestr(name, content)
    assert said in refusal(tmp_path / "other.fmu")


def test_model_exchange_alone_is_refused(python_fmu: Path, tmp_path: Path) -> None:
    description = files_in(python_fmu)[XML]
    found = re.search(rb"<CoSimulation.*?(/>|</CoSimulation>)", description, re.DOTALL)
    assert found is not None
    other = b'<ModelExchange modelIdentifier="SliderResonatorPy"/>'
    path = faulty_fmus.redescribed(python_fmu, tmp_path / "me.fmu", found[0], other)
    assert "model exchange only; must be co-simulation" in refusal(path)


def test_every_departure_from_the_interface_is_listed(native_fmu: Path, tmp_path: Path) -> None:
    changes = {
        b'name="phase"': b'name="phi"',
        b'"N"': b'"kN"',
        b'<Integer min="1" max="2" start="2" />': b'<Real unit="1" min="1" max="2" start="2" />',
    }

    def alter(name: str, content: bytes) -> bytes:
        for old, new in changes.items():
            content = content.replace(old, new) if name == XML else content
        return content

    message = refusal(faulty_fmus.altered(native_fmu, tmp_path / "other.fmu", alter))
    assert "input phase is missing" in message
    assert "load has unit kN, must be N" in message
    assert "blocking_force has unit kN" in message
    assert "friction_faces is of type Real, must be Integer" in message


def test_damage_and_missing_binaries_are_refused(native_fmu: Path, tmp_path: Path) -> None:
    damaged = bytearray(native_fmu.read_bytes())
    damaged[40:4000] = bytes(3960)
    path = tmp_path / "other.fmu"
    path.write_bytes(damaged)
    assert "cannot be " in refusal(path)
    path.write_text("hello")
    assert "must be a zip archive" in refusal(path)
    faulty_fmus.altered(
        native_fmu, path, lambda name, content: None if name.startswith("binaries/") else content
    )
    assert "no binary for " in refusal(path)


def test_log_categories_are_read_in_any_encoding(native_fmu: Path, tmp_path: Path) -> None:
    def alter(name: str, content: bytes) -> bytes:
        if name != XML:
            return content
        text = content.decode().replace("UTF-8", "ISO-8859-1", 1)
        return text.replace('author="', 'author="Föppl, ', 1).encode("latin-1")

    path = faulty_fmus.altered(native_fmu, tmp_path / "other.fmu", alter)
    with open_fmu(path) as fmu, open_fmu(native_fmu) as other:
        assert fmu.log_categories == other.log_categories != set()


def test_limit_that_is_no_number(native_fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(limits.MEMORY, "much")
    with pytest.raises(HarnessError, match="SLIDER_RESONATOR_MAX_MEMORY = 'much': must be a whole"):
        limits.max_bytes(limits.MEMORY)
    monkeypatch.setenv(limits.UNPACKED, "much")
    with pytest.raises(HarnessError, match=r"^SLIDER_RESONATOR_MAX_UNPACKED = 'much': must be"):
        open_fmu(native_fmu).__enter__()


NEWTON = {"kg": 1, "m": 1, "s": -2}


def test_every_unit_of_the_interface_has_a_dimension() -> None:
    assert {*INPUTS.values(), *PARAMETERS.values(), *OUTPUTS.values()} <= set(DIMENSIONS)


DEGREES = DisplayUnit("deg", 57.29578)
LENGTHS = [DisplayUnit("mm", 1e3), DisplayUnit("furlong", 7.0)]


@pytest.mark.parametrize(
    ("unit", "displayed", "base", "said"),
    [
        # The radian may count as a unit or as 1; display units may be rounded, or unknown ones.
        ("rad", [DEGREES], {}, None),
        ("rad", [DEGREES], {"rad": 1}, None),
        ("rad/s", [], {"s": -1}, None),
        ("rad/s", [], {"s": -1, "rad": 1}, None),
        ("m", LENGTHS, {"m": 1}, None),
        ("N", [], {**NEWTON, "factor": 1000.0}, "is defined with factor 1000.0, must be 1"),
        ("m", [], {"m": 1, "factor": 1e-3}, "is defined with factor 0.001, must be 1"),
        ("rad", [], {"rad": 1, "factor": pi / 180.0}, "is defined with factor 0.01745"),
        ("m", [], {"m": 1, "offset": 2.0}, "is defined with offset 2.0, must be 0"),
        ("m/s", [], {"m": 1, "s": -2}, "is defined as m s^-2, must be m s^-1"),
        ("s/m", [], {"s": 1}, "is defined as s, must be s m^-1"),
        ("1", [], {"K": 1}, "is defined as K, must be 1"),
        ("m", [DisplayUnit("mm", 1.0)], {"m": 1}, "is defined with factor 1.0, must be 1000"),
        ("rad/s", [DisplayUnit("Hz", 2.0 * pi)], {"s": -1}, "must be 0.159154943"),
        ("N", [DisplayUnit("mN", 1e3, 5.0)], NEWTON, "offset 5.0, must be 0"),
    ],
)
def test_definitions_of_units(
    unit: str, displayed: list[DisplayUnit], base: dict[str, float], said: str | None
) -> None:
    problems = [*unit_problems(unit, [Unit(unit, BaseUnit(**base), displayed)])]
    assert len(problems) == (said is not None), problems
    for problem in problems:
        assert f"unit {unit} is defined" in problem
        assert str(said) in problem


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


@every_slider
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
        return re.sub(declared, b"", content) if name == XML else content

    with open_fmu(altered(native_fmu, tmp_path / "other.fmu", alter)) as fmu:
        unknowns = [*fmu.description.outputs, *fmu.description.initialUnknowns]
        assert {one.dependencies for one in unknowns} == {None}
        assert description_faults(fmu.description) == []


def test_wrong_files_of_an_archive_are_named(native_fmu: Path, tmp_path: Path) -> None:
    description = read_model_description(str(native_fmu))
    extract(native_fmu, str(tmp_path))
    assert [*archive_faults(tmp_path, description)] == []
    (tmp_path / "sources/component/component.h").unlink()
    (tmp_path / "sources/base/other.c").touch()
    (tmp_path / "binaries/win64").mkdir(exist_ok=True)
    (tmp_path / "binaries/win64/SliderResonator.dll").write_bytes(b"\x7fELF")
    assert len([*archive_faults(tmp_path, description)]) == 3
