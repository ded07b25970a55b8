from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.processes import ROOT

(CODE,) = re.findall(
    r"```python\n(.*?)```", (ROOT / "docs" / "api.md").read_text("utf-8"), re.DOTALL
)


def test_the_example_of_the_page_runs(
    native_fmu: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("slider_resonator.fmu.finished.FOLDERS", (native_fmu.parent,))
    exec(compile(CODE, "docs/api.md", "exec"), {})
    assert (tmp_path / "start.png").is_file()
    assert (tmp_path / "curve.csv").read_text().count("\n") == 74
    assert "points     73" in capsys.readouterr().out
