"""Tables and foreign text that fit a terminal, or the log of a CI job: no name is split."""

import os
import re
import sys
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Literal

import rich.table
from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from slider_resonator.output.readable import escaped
from slider_resonator.output.table import Cell, Style, Table

_LABELLED = re.compile(r"\s*\S+(?: \S+)* {2,}(?=\S)")
"""The beginning of a line such as "cost     43 drive periods", up to its text."""


def terminal_width(*, err: bool = False) -> int | None:
    """Return the columns of the terminal that output or errors go to, None where it is none."""
    stream = sys.stderr if err else sys.stdout
    try:
        return os.get_terminal_size(stream.fileno()).columns if stream.isatty() else None
    except (AttributeError, OSError, ValueError):  # a closed stream, or one without a number
        return None


def fitting(text: str, width: int | None) -> str:
    """Return the text with lines of at most `width` columns, if it is given and words permit."""
    if width is None:
        return text
    lines = text.splitlines()
    for index, line in enumerate(lines):
        if len(line) > width:
            label = _LABELLED.match(line)
            start = len(label[0]) if label else 0
            if not 0 < start <= width // 2:
                start = len(line) - len(line.lstrip()) + len(INDENT)
            lines[index] = words(line, width, " " * start)
    return "\n".join(lines)


STYLES: Mapping[Style, str] = {
    Style.PLAIN: "",
    Style.PASS: "green",
    Style.FAIL: "bold red",
    Style.HEADING: "bold",
    Style.NOTE: "dim",
}
BETWEEN = 2
"""Columns between two columns of a table: padding and divider."""
INDENT = "  "


def words(text: str, width: int, indent: str = "") -> str:
    """Return the text wrapped between words; one that is too long stays whole."""
    wrapper = textwrap.TextWrapper(
        max(width, 1), subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )
    return "\n".join(wrapper.fill(line) for line in text.splitlines())


def _fitted(table: Table, available: int) -> list[int] | None:
    """Return the width of each column, None where they do not fit."""
    widths, min_widths = [], []
    for index, column in enumerate(table.columns):
        lines = [column.heading]
        for row in table.cells:
            if len(row) == len(table.columns) or (index == 0 and row[0].style is Style.HEADING):
                lines += row[index].text.splitlines()
            elif index == 0:
                lines += row[0].text.split()
        width = max(map(cell_len, lines))
        longest_word = max((cell_len(word) for line in lines for word in line.split()), default=0)
        widths.append(width)
        min_widths.append(width if column.numeric else min(width, max(20, longest_word)))
    excess = sum(widths) + BETWEEN * len(widths) - available
    for index in sorted(range(len(widths)), key=lambda i: min_widths[i] - widths[i]):
        cut = min(widths[index] - min_widths[index], max(excess, 0))
        widths[index] -= cut
        excess -= cut
    return widths if excess <= 0 else None


def _columns(table: Table, widths: Sequence[int]) -> rich.table.Table:
    if any(column.heading for column in table.columns):
        shown = rich.table.Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    else:
        shown = rich.table.Table.grid(padding=(0, BETWEEN, 0, 0))
    for column, width in zip(table.columns, widths, strict=True):
        justify: Literal["left", "right"] = "right" if column.numeric else "left"
        shown.add_column(Text(column.heading), justify=justify, min_width=width, max_width=width)
    for row in table.cells:
        if row[0].style is Style.HEADING:
            shown.add_section()
        shown.add_row(
            *(
                _text(replace(cell, text=words(cell.text, width)))
                for cell, width in zip(row, widths[: len(row)], strict=True)
            )
        )
    return shown


def _blocks(table: Table, width: int) -> Iterator[Text]:
    for row in table.cells:
        if len(row) < len(table.columns):
            blank = "\n" if row[0].style is Style.HEADING else ""
            yield Text(blank + words(row[0].text, width), STYLES[row[0].style])
            continue
        others = [one for one in zip(table.columns[1:], row[1:], strict=True) if one[1].text]
        bare = [_text(cell) for column, cell in others if not column.heading]
        yield Text("  ").join([_text(row[0]), *bare])
        line = ""
        for column, cell in others:
            if not column.heading:
                continue
            pair = f"{column.heading} {' '.join(cell.text.split())}"
            if line and cell_len(line) + len(INDENT) + cell_len(pair) + len(INDENT) > width:
                yield Text(words(INDENT + line, width, INDENT * 2))
                line = ""
            line += f"{INDENT if line else ''}{pair}"
        if line:
            yield Text(words(INDENT + line, width, INDENT * 2))


def _text(cell: Cell) -> Text:
    return Text(cell.text, STYLES[cell.style])


def show_table(console: Console, table: Table) -> None:
    """Print a table in the width of the console, without foreign control characters.

    Text is wrapped between words. Where that is not enough, each row becomes a block: the first
    cell and those without a heading on a line, all others with their headings below.
    """
    cells = [[Cell(escaped(cell.text), cell.style) for cell in row] for row in table.cells]
    safe = Table(table.columns, cells)
    widths = _fitted(safe, console.width)
    for part in _blocks(safe, console.width) if widths is None else [_columns(safe, widths)]:
        console.print(part)
