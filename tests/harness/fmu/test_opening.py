import re
import zipfile
from math import pi
from pathlib import Path

import pytest
from fmpy.model_description import BaseUnit, DisplayUnit, Unit

from slider_resonator.device.interface import INPUTS, OUTPUTS, PARAMETERS
from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu import limits, opening
from slider_resonator.fmu.interface_check import DIMENSIONS, unit_problems
from slider_resonator.fmu.opening import open_fmu
from tests.harness import faulty_fmus

XML = "modelDescription.xml"


def refusal(path: Path) -> str:
    with pytest.raises(FmuError) as caught, open_fmu(path):
        pass
    return str(caught.value)


def test_a_file_that_is_missing_or_no_archive_is_named(tmp_path: Path) -> None:
    assert "no such file" in refusal(tmp_path / "no.fmu")
    assert "is a directory" in refusal(tmp_path)
    text = tmp_path / "text.fmu"
    text.write_text("hello")
    assert "no zip archive" in refusal(text)


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({"readme.txt": "hello"}, "no modelDescription"),
        ({XML: "<fmiModelDescription"}, "cannot be read"),
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
    with zipfile.ZipFile(python_fmu) as archive:
        found = re.search(rb"<CoSimulation.*?(/>|</CoSimulation>)", archive.read(XML), re.DOTALL)
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
    faulty_fmus.altered(
        native_fmu, path, lambda name, content: None if name.startswith("binaries/") else content
    )
    assert "no binary for " in refusal(path)


def test_limit_that_is_no_number(native_fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(limits.MEMORY, "much")
    with pytest.raises(HarnessError, match="SLIDER_RESONATOR_MAX_MEMORY = 'much': must be a whole"):
        limits.max_bytes(limits.MEMORY)
    monkeypatch.setenv(limits.UNPACKED, "much")
    with pytest.raises(HarnessError, match=r"^SLIDER_RESONATOR_MAX_UNPACKED = 'much': must be"):
        open_fmu(native_fmu).__enter__()


NEWTON = {"kg": 1, "m": 1, "s": -2}


def problems(unit: str, *displayed: DisplayUnit, **base: float) -> list[str]:
    return [*unit_problems(unit, [Unit(unit, BaseUnit(**base), list(displayed))])]


def test_every_unit_of_the_interface_has_a_dimension() -> None:
    assert {*INPUTS.values(), *PARAMETERS.values(), *OUTPUTS.values()} <= set(DIMENSIONS)


@pytest.mark.parametrize("base", [{}, {"rad": 1}])
def test_the_radian_may_count_as_a_unit_or_as_1(base: dict[str, int]) -> None:
    assert problems("rad", **base) == []
    assert problems("rad/s", s=-1, **base) == []


@pytest.mark.parametrize(
    ("unit", "base", "message"),
    [
        ("N", {**NEWTON, "factor": 1000.0}, "unit N is defined with factor 1000.0, must be 1"),
        ("m", {"m": 1, "factor": 1e-3}, "unit m is defined with factor 0.001, must be 1"),
        ("rad", {"rad": 1, "factor": pi / 180.0}, "unit rad is defined with factor 0.01745"),
        ("m", {"m": 1, "offset": 2.0}, "unit m is defined with offset 2.0, must be 0"),
        ("m/s", {"m": 1, "s": -2}, "unit m/s is defined as m s^-2, must be m s^-1"),
        ("s/m", {"s": 1}, "unit s/m is defined as s, must be s m^-1"),
        ("1", {"K": 1}, "unit 1 is defined as K, must be 1"),
    ],
)
def test_another_definition_is_named(unit: str, base: dict[str, float], message: str) -> None:
    (problem,) = problems(unit, **base)
    assert problem.startswith(message)


def test_display_units_must_agree_with_their_names() -> None:
    rounded = DisplayUnit("deg", 57.29578)
    assert problems("rad", rounded, rad=1) == []
    assert problems("m", DisplayUnit("mm", 1e3), DisplayUnit("furlong", 7.0), m=1) == []
    assert problems("m", DisplayUnit("mm", 1.0), m=1) == [
        "display unit mm of unit m is defined with factor 1.0, must be 1000"
    ]
    (problem,) = problems("rad/s", DisplayUnit("Hz", 2.0 * pi), s=-1)
    assert problem.endswith("factor 6.283185307179586, must be 0.159154943")
    (problem,) = problems("N", DisplayUnit("mN", 1e3, 5.0), **NEWTON)
    assert problem.endswith("offset 5.0, must be 0")
