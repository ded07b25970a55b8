"""Tables, text and progress as they are shown: terminal, Markdown, pages, JSON."""

import json
import re
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len

from slider_resonator.output import html_page, markdown, readable, terminal
from slider_resonator.output.json_output import SCHEMA_VERSION, to_json
from slider_resonator.output.progress import progress_bar
from slider_resonator.output.table import Cell, Style, Table, numbers, texts, verdict
from slider_resonator.output.terminal import fitting
from tests.harness.golden import assert_as_before, screen

HOSTILE = "a|b\n::error::x \x1b[31m<b>`c` *d* _e_ f_g ~h~ [i](j) \\"
TABLE = Table(
    [*texts("host", ""), *numbers("off by [m]")],
    [
        [Cell("here", Style.HEADING)],
        ["one", verdict(True), "1e-9"],
        [HOSTILE, verdict(False), "0.1"],
        [Cell("because", Style.NOTE)],
    ],
)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("::set-output name=a::b", ": :set-output name=a::b"),
        ("log\n  ::stop-commands::x", "log\n  : :stop-commands::x"),
        ("a ::error::wrapped", "a : :error::wrapped"),
        ("x ##[error]y", "x ## [error]y"),
        ("std::vector, 12:30", "std::vector, 12:30"),
        ("bell\x07 red\x1b[31m \x9b2J\r\nnext\tcolumn", "bell� red�[31m �2J\nnext\tcolumn"),
        ("a\u202ebc", "a�bc"),
    ],
)
def test_text_for_a_terminal(text: str, shown: str) -> None:
    assert readable.escaped(text) == shown


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a|b", "a\\|b"),
        ("one\ntwo\r\nthree", "one<br>two<br>three"),
        ("<b>&amp;", "&lt;b>&amp;amp;"),
        ("`code` *strong* ~gone~ $x$ \\", "\\`code\\` \\*strong\\* \\~gone\\~ \\$x\\$ \\\\"),
        ("_soft_ steady_velocity", "\\_soft\\_ steady_velocity"),
        ("speed [m/s], ![image](http://x)", "speed [m/s], ![image]\\(http&#58;//x)"),
        ("www.example.org me@example.org", "www&#46;example.org me&#64;example.org"),
        ("\x1b[31m", "�[31m"),
    ],
)
def test_text_for_markdown(text: str, shown: str) -> None:
    assert markdown.escaped(text) == shown


def test_a_page_has_its_title_and_parts_and_needs_nothing_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    html_page.write_page(path, "a < b", ["<p>one</p>", "<p>two</p>"])
    page = path.read_text()
    assert "<title>a &lt; b</title>" in page
    assert page.index("<h1>a &lt; b</h1>") < page.index("<p>one</p>") < page.index("<p>two</p>")
    assert page.rstrip().endswith("</body></html>")
    assert "http" not in page.replace("http-equiv", "")
    assert "script-src" not in page, "no script runs"


def test_rows_of_a_table_too_wide_for_a_phone_are_cards_with_headings() -> None:
    columns = [*texts("scene"), *numbers("number", "error"), *texts("why")]
    row = ["table_1", "0.126667", "1e-9", "theory & practice"]
    assert "data-heading" not in html_page.rendered(Table(columns[:3], [row[:3]]))
    wide = html_page.rendered(Table(columns, [row]))
    assert wide.startswith('<div class="wide stacks">')
    assert all(f'data-heading="{column.heading}"' in wide for column in columns)


def test_a_table_in_every_form() -> None:
    """Numbers to the right, a row on its line, and foreign text that passes for nothing else."""
    printed = screen(lambda console: terminal.show_table(console, TABLE), 120)
    assert_as_before("table.txt", printed)
    assert_as_before("table.md", markdown.rendered(TABLE))
    assert_as_before("table.html", html_page.rendered(TABLE))


@dataclass(frozen=True)
class Result:
    value: float
    multipliers: tuple[complex, ...]
    note: str | None


def test_json_keeps_all_digits_and_has_its_version_in_each_object_at_the_top() -> None:
    result = Result(0.1266669970173598, (0.5 + 0.25j,), None)
    inner = {"numbers": [float("nan"), float("inf"), 1.5], "inner": {"c": True}}
    assert json.loads(to_json([result, inner])) == [
        {
            "schema_version": SCHEMA_VERSION,
            "value": 0.1266669970173598,
            "multipliers": [[0.5, 0.25]],
            "note": None,
        },
        {"schema_version": SCHEMA_VERSION, "numbers": [None, None, 1.5], "inner": {"c": True}},
    ]
    written = to_json({"a": "##[error]x"})
    assert json.loads(written) == {"schema_version": SCHEMA_VERSION, "a": "##[error]x"}
    assert "\\u0023#[error]x" in written, "no command of a workflow"


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
