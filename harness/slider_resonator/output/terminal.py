"""Tables and foreign text for a terminal or the log of a CI job."""

from __future__ import annotations

import re
from collections.abc import Mapping

import rich.table
from rich import box
from rich.text import Text

from slider_resonator.output.printable import printable
from slider_resonator.output.table import Cell, Style, Table

STYLES: Mapping[Style, str] = {
    Style.PLAIN: "",
    Style.PASS: "green",
    Style.FAIL: "bold red",
    Style.HEADING: "bold",
    Style.NOTE: "dim",
}
_WORKFLOW_COMMAND = re.compile(r"(?<!\S):(?=:)|##(?=\[)")
"""Where GitHub Actions may find a command in a log: `::name::` at the start of a line, which may be
a wrapped one, and `##[name]` anywhere."""


def escaped(text: str) -> str:
    """Return the text without control characters and commands to GitHub Actions."""
    return _WORKFLOW_COMMAND.sub(lambda found: f"{found[0]} ", printable(text))


def one_line(text: str) -> str:
    """Return foreign text, such as a path, for the middle of a line."""
    return escaped(" ".join(text.splitlines()))


def indented(text: str) -> str:
    """Return a message, escaped, whose further lines cannot pass for messages of their own."""
    return "\n  ".join(escaped(text).splitlines())


def rendered(table: Table) -> rich.table.Table:
    """Return the table for rich to print; each row with a heading begins a section."""
    shown = rich.table.Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    for column in table.columns:
        if column.numeric:
            shown.add_column(Text(column.heading), justify="right", no_wrap=True)
        else:
            shown.add_column(Text(column.heading), overflow="fold")
    for row in table.cells:
        if row[0].style is Style.HEADING:
            shown.add_section()
        shown.add_row(*map(_text, row))
    return shown


def _text(cell: Cell) -> Text:
    return Text(escaped(cell.text), STYLES[cell.style])
