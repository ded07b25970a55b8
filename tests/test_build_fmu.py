from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
import zipfile
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from fmpy.validation import validate_fmu

from build_fmu import PACKAGE, BuildError, build_python, main
from fmu_src.python.slider_resonator.variables import VARIABLES

ROOT = Path(__file__).resolve().parent.parent
BUILD = [sys.executable, str(ROOT / "build_fmu.py"), "--out"]


@pytest.fixture(scope="module")
def archive(python_fmu: Path) -> zipfile.ZipFile:
    return zipfile.ZipFile(python_fmu)


@pytest.fixture(scope="module")
def page(archive: zipfile.ZipFile) -> str:
    return archive.read("documentation/index.html").decode()


def description(fmu: Path) -> ET.Element:
    with zipfile.ZipFile(fmu) as archive:
        return ET.fromstring(archive.read("modelDescription.xml"))


def package_name(fmu: Path) -> str:
    with zipfile.ZipFile(fmu) as archive:
        (name,) = {
            n.split("/")[1] for n in archive.namelist() if re.search("slider_resonator_.*/", n)
        }
    return name


@pytest.fixture
def edited_package(tmp_path: Path) -> Path:
    """A copy of the component in which one comment differs."""
    copy = tmp_path / "slider_resonator"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    with (copy / "variables.py").open("a") as file:
        file.write("# one comment more\n")
    return copy


def test_fmpy_finds_no_problem(python_fmu: Path) -> None:
    assert validate_fmu(str(python_fmu)) == []


def test_fmutool_finds_no_problem(python_fmu: Path) -> None:
    fmutool = Path(sys.executable).with_name("fmutool")
    done = subprocess.run(
        [fmutool, "-input", python_fmu, "-check"], capture_output=True, text=True, check=False
    )
    report = done.stdout + done.stderr
    assert done.returncode == 0, report
    assert "compliant with FMI-2.0" in report
    assert "No semantic error" in report


def test_equal_bytes_wherever_and_however_it_is_built(python_fmu: Path, tmp_path: Path) -> None:
    elsewhere = tmp_path / "another place" / "dist"
    done = subprocess.run(
        [*BUILD, elsewhere],
        cwd=tmp_path,
        env=os.environ | {"PYTHONHASHSEED": "12345", "TZ": "Asia/Tokyo", "LC_ALL": "C"},
        umask=0o077,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    built = elsewhere / "SliderResonatorPy.fmu"
    assert built.read_bytes() == python_fmu.read_bytes(), (
        "folder, working folder, umask, time and hash seed must not show in the FMU"
    )


def test_source_date_epoch_sets_the_date_and_nothing_else(
    python_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    dated, plain = description(build_python(tmp_path)), description(python_fmu)
    assert dated.attrib.pop("generationDateAndTime") == "2023-11-14T22:13:20Z"
    assert plain.attrib.pop("generationDateAndTime") == "1980-01-01T00:00:00Z"
    assert ET.tostring(dated) == ET.tostring(plain)


def test_another_content_gets_another_name_and_guid(
    python_fmu: Path, tmp_path: Path, edited_package: Path
) -> None:
    other = build_python(tmp_path / "dist", edited_package)
    assert package_name(other) != package_name(python_fmu), "one process must tell builds apart"
    assert description(other).attrib["guid"] != description(python_fmu).attrib["guid"]


def test_names_inside_are_safe(archive: zipfile.ZipFile, python_fmu: Path) -> None:
    names = archive.namelist()
    assert names == sorted(names)
    assert [n for n in names if "\\" in n or n.startswith("/") or ".." in n] == []
    assert [n for n in names if "__pycache__" in n or n.endswith(".pyc")] == []
    assert re.fullmatch("slider_resonator_[0-9a-f]{12}", package_name(python_fmu))
    module = archive.read("resources/slavemodule.txt").decode()
    assert re.fullmatch("slider_resonator_py_[0-9a-f]{12}", module)
    assert f"resources/{module}.py" in names


def test_entries_carry_no_trace_of_the_build(archive: zipfile.ZipFile) -> None:
    for entry in archive.infolist():
        assert entry.date_time == (1980, 1, 1, 0, 0, 0), entry.filename
        assert entry.external_attr >> 16 == 0o100644, entry.filename
        assert entry.compress_type == zipfile.ZIP_DEFLATED, entry.filename
        if not entry.filename.startswith("binaries/"):
            assert str(ROOT).encode() not in archive.read(entry), entry.filename


def test_what_a_target_needs_is_inside(archive: zipfile.ZipFile) -> None:
    inside = set(archive.namelist())
    assert inside >= {
        "binaries/linux64/SliderResonatorPy.so",
        "binaries/win64/SliderResonatorPy.dll",
        "documentation/index.html",
        "documentation/licenses/license.txt",
        "documentation/licenses/pythonfmu.txt",
        "model.png",
        "resources/pythonfmu/fmi2slave.py",
    }
    assert archive.read("model.png").startswith(b"\x89PNG")
    licence = archive.read("documentation/licenses/license.txt")
    assert licence == (ROOT / "LICENSE").read_bytes()


def test_component_imports_the_standard_library_only(
    archive: zipfile.ZipFile, python_fmu: Path
) -> None:
    package = package_name(python_fmu)
    sources = [n for n in archive.namelist() if f"/{package}/" in n]
    allowed = sys.stdlib_module_names | {"pythonfmu"}
    for name in sources:
        for node in ast.walk(ast.parse(archive.read(name))):
            match node:
                case ast.Import(names=aliases):
                    modules = [alias.name for alias in aliases]
                case ast.ImportFrom(level=0, module=str(module)):
                    modules = [module]
                case _:
                    continue
            for imported in modules:
                assert imported.split(".")[0] in allowed, f"{name} imports {imported}"


def test_page_lists_every_variable(page: str) -> None:
    for v in VARIABLES:
        assert page.count(f"<td><code>{v.name}</code></td>") == 1, v.name


def test_page_is_self_contained_and_balanced(page: str) -> None:
    class Balance(HTMLParser):
        opened: list[str] = []  # noqa: RUF012 - one parser only

        def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
            assert not {"src", "href"} & {name for name, _ in attrs}, f"{tag} points elsewhere"
            if tag != "meta":
                self.opened.append(tag)

        def handle_endtag(self, tag: str) -> None:
            assert self.opened.pop() == tag, f"line {self.getpos()[0]}: </{tag}>"

    parser = Balance()
    parser.feed(page)
    assert parser.opened == []


def test_command_line_says_what_it_wrote(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--out", str(tmp_path)]) == 0
    assert str(tmp_path / "SliderResonatorPy.fmu") in capsys.readouterr().out
    assert [p.name for p in tmp_path.iterdir()] == ["SliderResonatorPy.fmu"], "no left-overs"


@pytest.mark.parametrize("date", ["yesterday", "-5", "1e9", "9" * 30])
def test_command_line_refuses_a_bad_date(
    date: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", date)
    assert main(["--out", str(tmp_path / "dist")]) == 2
    assert f"SOURCE_DATE_EPOCH = '{date}' refused" in capsys.readouterr().err
    assert not (tmp_path / "dist").exists(), "a failed build leaves nothing behind"


@pytest.mark.parametrize("folder", ["file", "file/dist"])
def test_command_line_refuses_a_file_as_folder(
    folder: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("kept")
    assert main(["--out", str(tmp_path / folder)]) == 2
    error = capsys.readouterr().err
    assert f"folder {tmp_path / folder} refused: {tmp_path / 'file'} is a file" in error
    assert (tmp_path / "file").read_text() == "kept"


def test_command_line_names_what_cannot_be_replaced(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "SliderResonatorPy.fmu").mkdir()
    assert main(["--out", str(tmp_path)]) == 2
    assert "Is a directory" in capsys.readouterr().err


def test_a_component_that_does_not_run_is_not_packaged(
    tmp_path: Path, edited_package: Path
) -> None:
    (edited_package / "slave.py").write_text("raise RuntimeError('broken on purpose')\n")
    with pytest.raises(BuildError, match="broken on purpose"):
        build_python(tmp_path / "dist", edited_package)
    assert not (tmp_path / "dist").exists()


def test_the_caller_keeps_its_modules_and_search_path(tmp_path: Path) -> None:
    path, modules = list(sys.path), {n for n in sys.modules if "slider_resonator_" in n}
    build_python(tmp_path)
    assert sys.path == path
    assert {n for n in sys.modules if "slider_resonator_" in n} == modules
