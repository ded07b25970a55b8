from __future__ import annotations

from io import StringIO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.output.fitting_text import fitting, terminal_width

COST = "cost     43 drive periods in 3 iterations, a common period is 1 of them"
SENTENCE = "  nearest to the bound: 0.36 of it in mean_velocity, case 5"


def test_a_labelled_line_goes_on_under_its_text() -> None:
    assert fitting(COST, 40).splitlines() == [
        "cost     43 drive periods in 3",
        "         iterations, a common period is",
        "         1 of them",
    ]


def test_other_lines_go_on_indented() -> None:
    assert fitting(f"short\n{SENTENCE}", 40).splitlines() == [
        "short",
        "  nearest to the bound: 0.36 of it in",
        "    mean_velocity, case 5",
    ]


def test_without_a_terminal_nothing_is_wrapped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdout", StringIO())
    assert terminal_width() is None
    assert fitting(COST, None) == COST


@given(st.text("ab_-. \n", max_size=80), st.integers(5, 40))
def test_no_word_is_cut_or_lost(text: str, width: int) -> None:
    fitted = fitting(text, width)
    assert fitted.split() == text.split()
    longest = max(map(len, text.split()), default=0)
    assert all(len(line) <= width or longest + width // 2 >= width for line in fitted.splitlines())
