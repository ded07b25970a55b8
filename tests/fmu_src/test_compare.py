import sys
import zipfile
from pathlib import Path

import pytest

from fmu_src.compare import main


def build(path: Path, **files: str) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return path


def test_files_that_differ_or_are_missing_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    one = build(tmp_path / "a.fmu", same="1", other="1", only_here="1", darwin64="1")
    two = build(tmp_path / "b.fmu", same="1", other="2", darwin64="2", only_there="1")
    for second, code, printed in (
        (one, 0, []),
        (two, 1, [f"a.fmu: {name} differs" for name in ("only_here", "only_there", "other")]),
    ):
        monkeypatch.setattr(sys, "argv", ["compare", str(one), str(second)])
        assert main() == code
        assert capsys.readouterr().out.splitlines() == printed
