"""The C sources inside the native FMU, compiled by a tool that knows only the description."""

import sys
import zipfile
from pathlib import Path

import pytest

from studies.hosts.hosts import hosts
from studies.hosts.runs import CASES, by_case, run_jobs, table_1_jobs
from tests.processes import run_command

pytestmark = pytest.mark.interop


def without_binaries(fmu: Path, target: Path) -> Path:
    with zipfile.ZipFile(fmu) as archive, zipfile.ZipFile(target, "w") as stripped:
        for name in archive.namelist():
            if not name.startswith("binaries/"):
                stripped.writestr(name, archive.read(name))
    return target


def test_fmutool_binary_gives_the_same_numbers(native_fmu: Path, tmp_path: Path) -> None:
    stripped = without_binaries(native_fmu, tmp_path / "stripped.fmu")
    compiled = tmp_path / "compiled.fmu"
    fmutool = Path(sys.executable).with_name("fmutool")
    done = run_command(fmutool, "-input", stripped, "-compile-sources", "-output", compiled)
    assert compiled.is_file(), done.stdout + done.stderr
    fmpy = hosts()[0]
    ours = [answer.rows for answer in run_jobs(fmpy, table_1_jobs(native_fmu))]
    compared = by_case(ours, run_jobs(fmpy, table_1_jobs(compiled)))
    failed = {case.title: compared[case] for case in CASES if not compared[case].passed}
    assert failed == {}, "another compiler must not make another motion"
