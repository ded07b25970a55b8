from __future__ import annotations

import json
from pathlib import Path

from click.testing import CliRunner, Result

from slider_resonator.cli import main


def call(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["crosscheck", *map(str, arguments)])


def test_the_tree_is_written_and_checked(native_fmu: Path, tmp_path: Path) -> None:
    result = call(native_fmu, "--out", tmp_path / "tree", "--tool", "MyTool", "--json")
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    assert report["passed"] is True
    ran = [row for row in report["folders"] if row["outliers"] is not None]
    assert len(ran) == 3
    assert all(Path(row["folder"]).parents[1].name == "MyTool" for row in report["folders"])
    again = call(native_fmu, "--out", tmp_path / "tree", "--tool", "MyTool")
    assert again.exit_code == 2
    assert "is there already" in again.stderr


def test_a_tool_is_the_name_of_a_folder(native_fmu: Path, tmp_path: Path) -> None:
    result = call(native_fmu, "--out", tmp_path, "--tool", "../up")
    assert result.exit_code == 2
    assert "must be letters" in result.stderr


def test_nothing_is_made_for_what_cannot_be_exported(python_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "tree"
    for fmu, reason in ((tmp_path / "no.fmu", "no such file"), (python_fmu, "needs a Python")):
        result = call(fmu, "--out", out)
        assert result.exit_code == 2
        assert reason in result.stderr
        assert not out.exists()


def test_a_folder_that_cannot_be_made_is_refused(native_fmu: Path) -> None:
    result = call(native_fmu, "--out", native_fmu / "inside")
    assert result.exit_code == 2
    assert "cannot be made a folder" in result.stderr
