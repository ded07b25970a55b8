from __future__ import annotations

import shutil
import zipfile
from pathlib import Path

import pytest
from fmpy import read_model_description

from fmu_src.building.c_sources import slider_sources
from fmu_src.building.compiling import FLAGS
from fmu_src.controller.variables import VARIABLES
from fmu_src.sources import CONTROLLER_SOURCES
from tests.fmu_src.building.test_native_fmu import WARNINGS
from tests.processes import run_command


def test_the_description_is_that_of_the_table(controller_fmu: Path) -> None:
    description = read_model_description(str(controller_fmu))
    found = [(v.name, v.causality, v.unit) for v in description.modelVariables]
    assert found == [(v.name, v.causality, v.unit) for v in VARIABLES]
    with zipfile.ZipFile(controller_fmu) as archive:
        page = archive.read("documentation/index.html").decode()
    for variable in VARIABLES:
        assert page.count(f"<td><code>{variable.name}</code></td>") == 1, variable.name


def test_only_the_velocity_error_depends_on_the_inputs(controller_fmu: Path) -> None:
    description = read_model_description(str(controller_fmu))
    found = {u.variable.name: [d.name for d in u.dependencies] for u in description.outputs}
    assert found == {
        "phase": [],
        "effort": [],
        "velocity_error": ["velocity_reference", "measured_velocity"],
    }, "with none at all, FMI Library takes each output to depend on each input"


def test_fmi_functions_are_shared_and_the_model_is_not(controller_fmu: Path) -> None:
    with zipfile.ZipFile(controller_fmu) as archive:
        inside = {
            name.removeprefix("sources/"): archive.read(name)
            for name in archive.namelist()
            if name.startswith("sources/")
        }
    slider = slider_sources()
    own = {name for name, data in inside.items() if data.decode() != slider.get(name)}
    generated = {"component/model_guid.h", "component/variables.c", "component/variables.h"}
    assert own == generated | {
        str(path.relative_to(CONTROLLER_SOURCES)) for path in CONTROLLER_SOURCES.rglob("*.[ch]")
    }
    assert not {"friction/coulomb.c", "friction/law.c", "device/device.h"} & set(inside)


@pytest.mark.skipif(shutil.which("gcc") is None, reason="needs gcc")
def test_sources_compile_alone_without_a_warning(controller_fmu: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(controller_fmu) as archive:
        archive.extractall(tmp_path)
    sources = tmp_path / "sources"
    files = [str(path.relative_to(sources)) for path in sources.rglob("*.c")]
    done = run_command("gcc", *FLAGS, *WARNINGS, "-o", "alone.so", *files, "-lm", cwd=sources)
    assert done.returncode == 0, done.stderr
