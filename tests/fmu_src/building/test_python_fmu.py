import ast
import re
import shutil
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from fmu_src.building.build_error import BuildError
from fmu_src.building.python_fmu import build_python
from fmu_src.sources import PACKAGE
from studies.mutants.archive import files_in


def identity(fmu: Path) -> tuple[str, str]:
    """The GUID and the name of the package inside."""
    files = files_in(fmu)
    (package,) = set(re.findall("slider_component_[^/ ]*(?=/)", " ".join(files)))
    return ET.fromstring(files["modelDescription.xml"]).attrib["guid"], package


@pytest.fixture
def edited_package(tmp_path: Path) -> Path:
    """A copy of the component in which one comment differs."""
    copy = tmp_path / "slider_component"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    with (copy / "variables.py").open("a") as file:
        file.write("# one comment more\n")
    return copy


def test_another_content_gets_another_name_and_guid(
    python_fmu: Path, tmp_path: Path, edited_package: Path
) -> None:
    path, modules = list(sys.path), set(sys.modules)
    other = build_python(tmp_path / "dist", edited_package)
    assert sys.path == path, "the caller keeps its own"
    assert not [name for name in {*sys.modules} - modules if "slider_component_" in name]
    for ours, theirs in zip(identity(python_fmu), identity(other), strict=True):
        assert ours != theirs, "one process must tell builds apart"


def test_component_imports_the_standard_library_only(python_fmu: Path) -> None:
    allowed = sys.stdlib_module_names | {"pythonfmu"}
    files, (_, package) = files_in(python_fmu), identity(python_fmu)
    for name in (n for n in files if f"/{package}/" in n):
        for node in ast.walk(ast.parse(files[name])):
            imported = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                imported = [str(node.module)]
            assert {module.split(".")[0] for module in imported} <= allowed, name


def test_a_component_that_does_not_run_is_not_packaged(
    tmp_path: Path, edited_package: Path
) -> None:
    (edited_package / "slave.py").write_text("raise RuntimeError('broken on purpose')\n")
    with pytest.raises(BuildError, match="broken on purpose"):
        build_python(tmp_path / "dist", edited_package)
    assert not (tmp_path / "dist").exists()


def test_a_folder_that_is_no_package_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"is not a Python package: it has no __init__\.py"):
        build_python(tmp_path / "dist", tmp_path)
