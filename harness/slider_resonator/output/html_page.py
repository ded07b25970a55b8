"""Tables, foreign text and whole pages in HTML; a page needs no other file."""

import base64
from collections.abc import Sequence
from functools import cache
from hashlib import sha256
from html import escape
from pathlib import Path

from slider_resonator.output.files import replacing
from slider_resonator.output.readable import printable
from slider_resonator.output.table import Cell, Column, Style, Table

PLOT = '<div class="plot">'
"""What begins a plot, which holds its data."""
SCRIPTS = ("vendor/uPlot.iife.min.js", "hover_plot.js")
"""Files beside this one that draw plots."""
STYLES = ("page.css", "vendor/uPlot.min.css", "hover_plot.css")


def escaped(text: str) -> str:
    """Return the text escaped for an element or a quoted attribute."""
    return escape(printable(text))


def rendered(table: Table) -> str:
    """Return the table as HTML: on a phone the rows of one with over 3 columns are cards."""
    has_headings = any(column.heading for column in table.columns)
    stacks = has_headings and len(table.columns) > 3
    body = "\n".join(f"<tr>{_row(row, table.columns, stacks)}</tr>" for row in table.cells)
    head = "".join(_element("th", Cell(column.heading), column) for column in table.columns)
    headings = f"<thead><tr>{head}</tr></thead>" if has_headings else ""
    kind = "wide stacks" if stacks else "wide"
    return f'<div class="{kind}"><table>{headings}<tbody>\n{body}\n</tbody></table></div>'


def folded(summary: str, html: str) -> str:
    """Return HTML, such as a wide table, that a click on the summary unfolds."""
    return f"<details><summary>{escaped(summary)}</summary>{html}</details>"


def section(anchor: str, heading: str, note: str, html: str, *, unfolded: bool) -> str:
    """Return a section with an id and a heading, that a click, or a link to it, unfolds."""
    return (
        f'<details id="{escaped(anchor)}"{" open" if unfolded else ""}>'
        f"<summary><h3>{escaped(heading)}</h3> {escaped(note)}</summary>{html}</details>"
    )


def write_page(path: Path, title: str, parts: Sequence[str]) -> None:
    """Write a page with a title and parts of HTML; HarnessError when it cannot be written.

    It may load images in its folder, nothing else, and runs no other scripts than those that draw
    plots, if it has some.
    """
    scripts = [_file(name) for name in SCRIPTS if any(PLOT in part for part in parts)]
    policy = "default-src 'none'; img-src data: 'self' file:; style-src 'unsafe-inline'"
    if scripts:
        digests = [base64.b64encode(sha256(one.encode()).digest()).decode() for one in scripts]
        policy += "; script-src " + " ".join(f"'sha256-{digest}'" for digest in digests)
    style = "".join(map(_file, STYLES))
    page = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
        '<link rel="icon" href="data:,">',
        f"<title>{escaped(title)}</title><style>{style}</style></head><body>",
        f"<h1>{escaped(title)}</h1>",
        *parts,
        *(f"<script>{script}</script>" for script in scripts),
        "</body></html>",
    ]
    with replacing(path) as temporary:
        temporary.write_text("\n".join(page) + "\n", encoding="utf-8", errors="replace")


@cache
def _file(name: str) -> str:
    return (Path(__file__).parent / name).read_text(encoding="utf-8")


def _row(row: Sequence[Cell], columns: Sequence[Column], stacks: bool) -> str:
    if len(row) < len(columns):
        return f'<td colspan="{len(columns)}">{_text(row[0])}</td>'
    pairs = zip(row, columns, strict=True)
    return "".join(_element("td", cell, column, stacks) for cell, column in pairs)


def _element(tag: str, cell: Cell, column: Column, stacks: bool = False) -> str:
    """Return a cell; one of a table that stacks carries its heading, a long one has a line."""
    kinds = ["n"] if column.numeric else ["lines"] if "\n" in cell.text else []
    kinds += ["long"] if stacks and len(cell.text) > 18 else []
    kind = f' class="{" ".join(kinds)}"' if kinds else ""
    heading = f' data-heading="{escaped(column.heading)}"' if stacks else ""
    note = f' title="{escaped(cell.note)}"' if cell.note else ""
    return f"<{tag}{kind}{heading}{note}>{_text(cell)}</{tag}>"


def _text(cell: Cell) -> str:
    text = escaped(cell.text).replace("\n", "<br>")
    if cell.target:
        text = f'<a href="#{escaped(cell.target)}">{text}</a>'
    return text if cell.style is Style.PLAIN else f'<span class="{cell.style.value}">{text}</span>'
