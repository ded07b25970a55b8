from __future__ import annotations

import io
from html.parser import HTMLParser
from pathlib import Path

import pytest
from rich.console import Console

from slider_resonator.output import html_page, markdown, readable, terminal
from slider_resonator.output.table import Cell, Style, Table, numbers, texts, verdict

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


def printed(table: Table) -> list[str]:
    console = Console(file=io.StringIO(), width=120, force_terminal=False)
    console.print(terminal.rendered(table))
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue().splitlines()


def test_a_row_of_another_length_is_refused() -> None:
    with pytest.raises(ValueError, match="2 cells in a table of 3 columns"):
        Table(texts("a", "b", "c"), [["1", "2"]])


def test_the_terminal_aligns_numbers_to_the_right_and_keeps_brackets() -> None:
    head, *_, last = [line for line in printed(TABLE) if line.strip()][:4]
    assert head.rstrip().endswith("off by [m]")
    assert last.rstrip().endswith("1e-9")
    assert len(head.rstrip()) == len(last.rstrip())
    assert "pass" in last


def test_the_terminal_shows_foreign_text_without_control_characters_and_commands() -> None:
    lines = printed(TABLE)
    assert not any("\x1b" in line for line in lines)
    assert not any(line.lstrip().startswith("::") for line in lines)
    assert any(": :error::x" in line for line in lines)


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


def test_markdown_keeps_each_row_on_its_line_with_all_cells() -> None:
    lines = markdown.rendered(TABLE).splitlines()
    assert lines[:4] == [
        "| host |  | off by [m] |",
        "| --- | --- | ---: |",
        "| **here** |  |  |",
        "| one | pass | 1e-9 |",
    ]
    assert lines[4].endswith("| **FAIL** | 0.1 |")
    assert len(lines) == 6
    for line in lines:
        assert line.replace("\\|", "").count("|") == 4


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


class Cells(HTMLParser):
    """The tags of a table and the text in it."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.text = ""
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)

    def handle_data(self, data: str) -> None:
        self.text += data


def test_html_marks_numbers_and_styles_and_escapes_foreign_text() -> None:
    page = html_page.rendered(TABLE)
    assert '<th class="n">off by [m]</th>' in page
    assert '<td class="n">1e-9</td>' in page
    assert '<span class="fail">FAIL</span>' in page
    assert '<td colspan="3"><span class="note">because</span></td>' in page
    cells = Cells(page)
    assert "b" not in cells.tags
    assert cells.tags.count("tr") == 5
    assert "::error::x �[31m<b>`c`" in cells.text


def test_html_keeps_options_and_small_numbers_in_one_piece() -> None:
    cells = [["4e-8 m of 5e-3 mm: run --cell 'a-b' my-file"]]
    page = html_page.rendered(Table(texts("note"), cells))
    assert page.count('<span class="lines">') == 2
    assert '<span class="lines">--cell</span>' in page
    assert '<span class="lines">5e-3</span>' in page


def test_html_in_an_attribute_stays_there() -> None:
    assert html_page.escaped("\" onload='x'") == "&quot; onload=&#x27;x&#x27;"
    assert html_page.folded("<2 rows>", "<table></table>").startswith(
        "<details><summary>&lt;2 rows&gt;</summary>"
    )


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
    headings = ("a_long_name_of_a_scene", "number", "why it must hold")
    columns = [*texts(headings[0]), *numbers(headings[1]), *texts(headings[2])]
    narrow = html_page.rendered(Table(columns, [["table_1", "0.126667", "theory & practice"]]))
    assert "data-heading" not in narrow
    wide = html_page.rendered(Table(columns, [["table_1", "1" * 45, "theory & practice"]]))
    assert wide.startswith('<div class="wide stacks">')
    assert all(f'data-heading="{heading}"' in wide for heading in headings)
    long = html_page.rendered(Table(columns[:1], [["words that can be wrapped " * 9]]))
    assert "stacks" not in long, "words wrap"
