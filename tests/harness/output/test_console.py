from __future__ import annotations

import pytest

from slider_resonator.output.console import output, progress_bar


def test_progress_is_silent_without_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_bar() as progress:
        progress("scene", 0.5)
    captured = capsys.readouterr()
    assert captured.out == captured.err == ""


def test_a_log_is_no_wider_than_a_page() -> None:
    assert output().width == 120
