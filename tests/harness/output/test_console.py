import re
from io import StringIO

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len

from slider_resonator.output.progress import progress_bar
from slider_resonator.output.terminal import fitting


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
    assert all("C host" in line and "0:00:0" in line for line in shown)
    assert max(map(cell_len, lines)) <= width


@given(st.text("ab_-. \n", max_size=80), st.integers(5, 40))
def test_no_word_is_cut_or_lost(text: str, width: int) -> None:
    fitted = fitting(text, width)
    assert fitted.split() == text.split()
    longest = max(map(len, text.split()), default=0)
    assert all(len(line) <= width or longest + width // 2 >= width for line in fitted.splitlines())


@pytest.mark.parametrize("value", ["-0.5 mm/s", "1e-9 N", "12 %", "5 1/m", "9 drive periods"])
def test_a_number_stays_with_its_unit(value: str) -> None:
    text = f"costs at least {value}, the other more; {value} or {value}"
    for width in range(8, 40):
        lines = fitting(text, width).splitlines()
        assert sum(line.count(value) for line in lines) == 3, lines
        assert " ".join(" ".join(lines).split()) == text
