import sys
import zipfile
from pathlib import Path

from fmu_src.compare import differing_files
from tests.processes import ROOT, run_command


def build(path: Path, **files: str) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return path


def test_files_that_differ_or_are_missing_are_named(tmp_path: Path) -> None:
    one = build(tmp_path / "a.fmu", same="1", other="1", only_here="1", darwin64="1")
    two = build(tmp_path / "b.fmu", same="1", other="2", darwin64="2", only_there="1")
    assert differing_files(one, one) == []
    assert differing_files(one, two) == ["only_here", "only_there", "other"]
    command = (sys.executable, "-m", "fmu_src.compare", one)
    assert run_command(*command, one, cwd=ROOT).returncode == 0
    done = run_command(*command, two, cwd=ROOT)
    assert done.returncode == 1
    assert "a.fmu: other differs" in done.stdout
