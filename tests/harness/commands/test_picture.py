from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from slider_resonator.cli import main


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "Missing option '--out'"),
        (["--out", "p.txt"], "'.txt'; must be one of .png, .svg, .pdf"),
        (["--out", "my.png"], "--out my.png is the FMU"),
    ],
)
def test_nothing_is_drawn_over_what_was_not_meant(
    arguments: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("my.png").write_text("an FMU of this name")
    result = CliRunner().invoke(main, ["picture", "my.png", *arguments])
    assert result.exit_code == 2
    assert said in result.stderr
    assert Path("my.png").read_text() == "an FMU of this name"
