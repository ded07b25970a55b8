from __future__ import annotations

from io import StringIO

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from slider_resonator.output.table import Table, texts
from slider_resonator.output.terminal import fitting, rendered, terminal_width

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


@pytest.mark.parametrize(
    "value",
    [
        "0.602 s",
        "-0.5 mm/s",
        "1e-9 N",
        "35 rad/s",
        "12 %",
        "5 1/m",
        "915 MB",
        "0 um",
        "9 drive periods",
    ],
)
def test_a_number_stays_with_its_unit(value: str) -> None:
    text = f"costs at least {value}, the other more; {value} or {value}"
    for width in range(8, 40):
        lines = fitting(text, width).splitlines()
        assert sum(line.count(value) for line in lines) == 3, lines
        assert " ".join(" ".join(lines).split()) == text


def test_a_word_that_begins_like_a_unit_is_wrapped() -> None:
    assert fitting("in 100 milliseconds", 8).splitlines() == ["in 100", "  milliseconds"]
    assert fitting("after 100 s_m", 9).splitlines() == ["after 100", "  s_m"]


@pytest.mark.parametrize("width", [30, 45, 60, 80])
def test_a_number_stays_with_its_unit_in_a_table(width: int) -> None:
    reason = "costs at least 0.602 s, the chosen 0.001 s, which is 601 ms less"
    table = Table(texts("ruled out", "why"), [("fidelity 0, order 2, Coulomb friction", reason)])
    console = Console(file=StringIO(), width=width)
    console.print(rendered(table))
    assert isinstance(console.file, StringIO)
    shown = console.file.getvalue()
    for value in ("0.602 s", "0.001 s", "601 ms"):
        assert value in shown, shown
