"""Tables and foreign text for a terminal or the log of a CI job."""

from __future__ import annotations

import re

from slider_resonator.output.fitting_table import FittingTable
from slider_resonator.output.printable import printable
from slider_resonator.output.table import Cell, Table

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


def rendered(table: Table) -> FittingTable:
    """Return the table for rich to print, escaped; each row with a heading begins a section."""
    rows = [[Cell(escaped(cell.text), cell.style) for cell in row] for row in table.cells]
    return FittingTable(Table(table.columns, rows))
