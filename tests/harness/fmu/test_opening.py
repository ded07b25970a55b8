from __future__ import annotations

import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from slider_resonator.errors import FmuError
from slider_resonator.fmu.opening import open_fmu

XML = "modelDescription.xml"


def altered(source: Path, target: Path, change: Callable[[str], str]) -> Path:
    """Copy an FMU with another model description."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            if name == XML:
                text = content.decode()
                assert change(text) != text, "the alteration must alter something"
                content = change(text).encode()
            new.writestr(name, content)
    return target


def test_an_fmu_is_unpacked_and_removed_again(python_fmu: Path) -> None:
    with open_fmu(python_fmu) as fmu:
        assert (fmu.folder / XML).is_file()
        assert fmu.variables["phase"].unit == "rad"
        folder = fmu.folder
    assert not folder.exists()


def test_a_file_that_is_missing_or_no_fmu_is_named(tmp_path: Path) -> None:
    with pytest.raises(FmuError, match="no such file"), open_fmu(tmp_path / "no.fmu"):
        pass
    text = tmp_path / "text.fmu"
    text.write_text("hello")
    with pytest.raises(FmuError, match="no zip archive"), open_fmu(text):
        pass
    with zipfile.ZipFile(tmp_path / "empty.fmu", "w") as archive:
        archive.writestr("readme.txt", "hello")
    with pytest.raises(FmuError, match="no modelDescription"), open_fmu(tmp_path / "empty.fmu"):
        pass


def test_a_directory_is_named_as_one(tmp_path: Path) -> None:
    (tmp_path / "dir.fmu").mkdir()
    with pytest.raises(FmuError, match="is a directory"), open_fmu(tmp_path / "dir.fmu"):
        pass


@pytest.mark.parametrize("version", ["1.0", "3.0"])
def test_another_version_of_fmi_is_named(tmp_path: Path, version: str) -> None:
    with zipfile.ZipFile(tmp_path / "other.fmu", "w") as archive:
        archive.writestr(XML, f'<fmiModelDescription fmiVersion="{version}" modelName="x"/>')
    message = rf"FMI version {version}; must be 2\.0"
    with pytest.raises(FmuError, match=message), open_fmu(tmp_path / "other.fmu"):
        pass


def test_model_exchange_alone_is_refused(python_fmu: Path, tmp_path: Path) -> None:
    def change(text: str) -> str:
        element = re.search(r"<CoSimulation.*?(/>|</CoSimulation>)", text, re.DOTALL)
        assert element is not None
        return text.replace(element[0], '<ModelExchange modelIdentifier="SliderResonatorPy"/>')

    path = altered(python_fmu, tmp_path / "me.fmu", change)
    with pytest.raises(FmuError, match="model exchange only; must be co-simulation"):
        open_fmu(path).__enter__()


def test_a_description_that_is_not_xml_is_an_error_of_the_fmu(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "bad.fmu", "w") as archive:
        archive.writestr(XML, "<fmiModelDescription")
    with pytest.raises(FmuError, match="cannot be read"), open_fmu(tmp_path / "bad.fmu"):
        pass


def test_every_departure_from_the_interface_is_listed(python_fmu: Path, tmp_path: Path) -> None:
    def change(text: str) -> str:
        return text.replace('name="phase"', 'name="phi"').replace('"N"', '"kN"')

    path = altered(python_fmu, tmp_path / "other.fmu", change)
    with pytest.raises(FmuError) as caught, open_fmu(path):
        pass
    message = str(caught.value)
    assert "input phase is missing" in message
    assert "load has unit kN, must be N" in message
    assert "blocking_force has unit kN" in message


def test_a_binary_for_another_platform_only_is_named(python_fmu: Path, tmp_path: Path) -> None:
    path = tmp_path / "bare.fmu"
    with zipfile.ZipFile(python_fmu) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            if not name.startswith("binaries/"):
                new.writestr(name, old.read(name))
    with pytest.raises(FmuError, match="no binary for"), open_fmu(path):
        pass


def test_unknown_names_suggest_the_nearest(python_fmu: Path) -> None:
    with open_fmu(python_fmu) as fmu, pytest.raises(FmuError, match="did you mean 'phase'"):
        fmu.settable("phas")


def test_an_output_cannot_be_set(python_fmu: Path) -> None:
    with open_fmu(python_fmu) as fmu, pytest.raises(FmuError, match="'velocity'"):
        fmu.settable("velocity")
