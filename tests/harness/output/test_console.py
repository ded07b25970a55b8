from __future__ import annotations

import re
from io import StringIO

import pytest
from rich.cells import cell_len

from slider_resonator.output.console import output
from slider_resonator.output.progress import counted, part_of
from slider_resonator.output.progress_bar import progress_bar, shortened, time_left
from slider_resonator.output.readable import readable


def test_progress_is_silent_without_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_bar() as progress:
        progress("scene", 0.5)
    captured = capsys.readouterr()
    assert captured.out == captured.err == ""


class Terminal(StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("width", [60, 80, 120])
def test_progress_stays_on_one_line(width: int, monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setenv("TERM", "xterm")
    with progress_bar() as progress:
        progress("3 of 33: C host: resolved Coulomb, 1 drive period, no set or get", 0.5)
    lines = re.split(
        r"[\r\n]|\x1b\[2K", re.sub(r"\x1b\[[0-9;?]*[A-JL-Za-z]", "", terminal.getvalue())
    )
    shown = [line for line in lines if "3 of 33" in line]
    assert shown
    assert all("set or get" in line and "0:00:0" in line for line in shown)
    assert max(map(cell_len, lines)) <= width


def test_a_long_label_keeps_its_beginning_and_its_end() -> None:
    assert shortened("3 of 33: table_1", 16) == "3 of 33: table_1"
    assert (
        shortened("3 of 33: a_long_name_of_a_scene", 16) == "3 of 33\N{HORIZONTAL ELLIPSIS}_a_scene"
    )


def test_a_log_is_no_wider_than_a_page() -> None:
    assert output().width == 120


@pytest.mark.parametrize("value", [0.0, -0.0, -1.7e-14, 9e-13])
def test_noise_and_minus_zero_are_0(value: float) -> None:
    assert readable(value, 10) == "0"


def test_other_numbers_keep_their_digits_and_sign() -> None:
    assert readable(0.12666699702, 10) == "0.126666997"
    assert readable(-2e-12, 9) == "-2e-12"
    assert readable(199, 8) == "199"


def test_a_task_has_its_number() -> None:
    assert counted("table_1", 0, 33) == "1 of 33: table_1"
    assert counted("table_1", 33, 33) == "33 of 33: table_1"


def test_a_part_reports_its_share_of_all_work() -> None:
    reported: list[tuple[str, float]] = []
    part_of(lambda label, share: reported.append((label, share)), 1, 4)("second of four", 0.5)
    assert reported == [("second of four", 0.375)]


@pytest.mark.parametrize(
    ("elapsed", "share", "text"),
    [
        (10.0, 0.0, ""),
        (10.0, 0.01, ""),
        (10.0, 0.5, "0:10 left"),
        (30.0, 0.25, "1:30 left"),
        (900.0, 0.1, "2:15:00 left"),
        (10.0, 1.0, "0:00 left"),
        (10.0, float("nan"), ""),
    ],
)
def test_the_time_left_follows_from_the_share_done(elapsed: float, share: float, text: str) -> None:
    assert time_left(elapsed, share) == text
