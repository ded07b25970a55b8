from __future__ import annotations

import json
from pathlib import Path

from click.testing import CliRunner, Result

from harness.cli import main


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
    assert "allowed are letters" in result.stderr
