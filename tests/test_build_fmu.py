"""The command, and what holds for both FMUs that it builds."""

import os
import sys
import zipfile
from importlib.metadata import entry_points
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu

from build_fmu import main
from fmu_src.building.platforms import HOST
from fmu_src.building.python_fmu import MODEL as PYTHON_MODEL
from fmu_src.controller.variables import VARIABLES as CONTROLLER
from fmu_src.python.slider_component.variables import VARIABLES
from studies.mutants.archive import files_in
from tests.fmus import every_fmu, every_slider
from tests.processes import ROOT, run_command

PYTHON = ["--only", "python"]
NATIVE = ["--only", "native", "--platform", HOST]
NATIVE_3 = ["--only", "fmi3", "--platform", HOST]
OPTIONS = {"SliderResonatorPy": PYTHON, "SliderResonator": NATIVE, "SliderResonator3": NATIVE_3}
"""Options that build an FMU, by its name."""
TABLES = {"VelocityController": CONTROLLER}
"""Other variables than those of the slider, by the name of the FMU."""


@pytest.fixture
def archive(fmu: Path) -> zipfile.ZipFile:
    return zipfile.ZipFile(fmu)


def description(fmu: Path) -> ET.Element:
    return ET.fromstring(files_in(fmu)["modelDescription.xml"])


@every_fmu
def test_fmpy_and_fmutool_find_no_problem(
    fmu: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert validate_fmu(str(fmu)) == []
    monkeypatch.setattr(sys, "argv", ["fmutool", "-input", str(fmu), "-check"])
    (fmutool,) = entry_points(group="console_scripts", name="fmutool")
    fmutool.load()()  # exits where it finds an error
    report = capsys.readouterr()
    version = description(fmu).attrib["fmiVersion"]
    assert f"compliant with FMI-{version}" in report.out + report.err
    assert "No semantic error" in report.out + report.err


def test_equal_bytes_wherever_and_however_they_are_built(
    native_fmu: Path,
    python_fmu: Path,
    native_3_fmu: Path,
    controller_fmu: Path,
    closed_loop_package: Path,
    tmp_path: Path,
) -> None:
    """All but the page, which is for all platforms."""
    elsewhere = tmp_path / "another place" / "dist"
    changed = {"PYTHONHASHSEED": "12345", "TZ": "Asia/Tokyo", "LC_ALL": "C"}
    done = run_command(
        *(sys.executable, ROOT / "build_fmu.py", "--out", elsewhere, "--platform", HOST),
        cwd=tmp_path,
        env={**os.environ, **changed, "TMPDIR": str(tmp_path)},
        umask=0o077,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == "", "progress is for a terminal, not for a file"
    assert "Native FMUs for this machine" in done.stdout
    built = (native_fmu, python_fmu, native_3_fmu, controller_fmu, closed_loop_package)
    assert {path.name for path in elsewhere.iterdir()} == {one.name for one in built}
    for one in built:
        assert str(elsewhere / one.name) in done.stdout
        assert (elsewhere / one.name).read_bytes() == one.read_bytes(), (
            f"folder, working folder, umask, time and hash seed must not show in {one.name}"
        )


@every_slider
def test_source_date_epoch_sets_the_date_and_nothing_else(
    fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    assert main(["--out", str(tmp_path), *OPTIONS[fmu.stem]]) == 0
    dated, plain = description(tmp_path / fmu.name), description(fmu)
    assert dated.attrib.pop("generationDateAndTime") == "2023-11-14T22:13:20Z"
    assert plain.attrib.pop("generationDateAndTime") == "1980-01-01T00:00:00Z"
    assert ET.tostring(dated) == ET.tostring(plain)


@every_slider
def test_entries_are_in_order_and_carry_no_trace_of_the_build(
    archive: zipfile.ZipFile, fmu: Path
) -> None:
    names = archive.namelist()
    assert names == sorted(names)
    assert [n for n in names if "\\" in n or n.startswith("/") or ".." in n] == []
    assert [n for n in names if "__pycache__" in n or n.endswith((".pyc", ".o"))] == []
    for entry in archive.infolist():
        assert entry.date_time == (1980, 1, 1, 0, 0, 0), entry.filename
        assert entry.external_attr >> 16 == 0o100644, entry.filename
        assert entry.compress_type == zipfile.ZIP_DEFLATED, entry.filename
        if fmu.stem != PYTHON_MODEL or not entry.filename.startswith("binaries/"):
            traces = [str(ROOT).encode(), str(Path.home()).encode(), b"/tmp/"]
            found = [t for t in traces if t in archive.read(entry)]
            assert found == [], entry.filename


@every_slider
def test_icon_and_licence_are_inside(archive: zipfile.ZipFile) -> None:
    icons = [name for name in archive.namelist() if name.endswith(".png")]
    assert icons in (["model.png"], ["terminalsAndIcons/icon.png"])
    assert archive.read(icons[0]).startswith(b"\x89PNG")
    licence = archive.read("documentation/licenses/license.txt")
    assert licence == (ROOT / "LICENSE").read_bytes()


@every_fmu
def test_variables_are_those_of_the_table(fmu: Path) -> None:
    """After the time, which is a variable in FMI 3.0. Numbers read back exactly."""
    table = TABLES.get(fmu.stem, VARIABLES)
    variables = read_model_description(str(fmu)).modelVariables[-len(table) :]
    first = variables[0].valueReference
    types = {"Float64": "Real", "Int32": "Integer"}
    page = zipfile.ZipFile(fmu).read("documentation/index.html").decode()
    for reference, (row, found) in enumerate(zip(table, variables, strict=True), start=first):
        assert (found.name, found.valueReference) == (row.name, reference)
        assert (types.get(found.type, found.type), found.causality) == (row.type, row.causality)
        assert (found.variability, found.description) == (row.variability, row.description)
        assert (found.unit, found.displayUnit) == (row.unit, row.display_unit), row.name
        numbers = (found.start, found.min, found.max, found.nominal)
        expected = (row.start, row.minimum, row.maximum, row.nominal)
        assert tuple(None if x is None else float(x) for x in numbers) == expected, row.name
        assert page.count(f"<td><code>{row.name}</code></td>") == 1, row.name
    assert first == (2 if fmu.stem == "SliderResonator3" else 0)


def test_only_the_velocity_error_of_the_controller_depends_on_inputs() -> None:
    depends = {v.name: v.depends_on for v in CONTROLLER if v.causality == "output" and v.depends_on}
    assert depends == {"velocity_error": ("velocity_reference", "measured_velocity")}, (
        "with none at all, FMI Library takes each output to depend on each input"
    )


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["system", "--platform", HOST], "SliderResonator.fmu: no such file; ClosedLoop.ssp needs"),
        (["native", "--compiler", "no-such-cc"], "compiler 'no-such-cc' refused: it is not found"),
    ],
)
def test_what_a_build_needs_is_named(
    arguments: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--out", str(tmp_path / "dist"), "--only", *arguments]) == 2
    assert said in capsys.readouterr().err
    assert {path.name for path in tmp_path.rglob("*.*")} <= {"VelocityController.fmu"}


@pytest.mark.parametrize("only", ["native", "python", "fmi3"])
def test_bad_folders_and_dates_are_refused(
    only: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "file"
    file.write_text("kept")
    for folder in (file, file / "dist"):
        assert main(["--out", str(folder), "--only", only]) == 2
        assert f"folder {folder} refused: {file} is a file" in capsys.readouterr().err
    assert file.read_text() == "kept"
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    assert main(["--out", str(tmp_path / "dist"), "--only", only]) == 2
    assert "SOURCE_DATE_EPOCH = 'yesterday' refused" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["file"], "nothing is left behind"


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--platform", "amiga"], "invalid choice: 'amiga'"),
        (["--only", "python", "--platform", "win64"], "they are for the native FMU"),
        (["--only", "python", "--compiler", "cc"], "they are for the native FMU"),
    ],
)
def test_options_that_make_no_sense_are_refused(
    arguments: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2
    assert reason in capsys.readouterr().err
