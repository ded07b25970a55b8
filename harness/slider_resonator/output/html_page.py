"""Tables, foreign text and whole pages in HTML; a page needs no other file."""

from __future__ import annotations

import base64
import re
from collections.abc import Sequence
from hashlib import sha256
from html import escape
from pathlib import Path

from slider_resonator.output.atomic import replacing
from slider_resonator.output.printable import printable
from slider_resonator.output.table import Cell, Column, Style, Table

_STYLE = """
:root { color-scheme: light dark; --ink: #222; --paper: #fff; --quiet: #666; --line: #ddd;
  --code: #f6f6f6; --pass: #1a7f37; --fail: #b3261e; --shade: #0003 }
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem; padding: 0 1rem;
  color: var(--ink); background: var(--paper); overflow-wrap: break-word }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums }
th, td { text-align: left; vertical-align: top; overflow-wrap: normal; padding: .2rem .6rem;
  border-bottom: 1px solid var(--line) }
.n { text-align: right } .n, .lines { white-space: nowrap }
.pass { color: var(--pass) } .fail { color: var(--fail); font-weight: 600 }
.note { color: var(--quiet) } .heading { font-weight: 600 } [style*=background] { color: #222 }
.wide { overflow-x: auto; margin: .8rem 0; background:
  linear-gradient(to right, var(--paper) 50%, transparent) local 0/2rem 100% no-repeat,
  linear-gradient(to left, var(--paper) 50%, transparent) local 100%/2rem 100% no-repeat,
  linear-gradient(to right, var(--shade), transparent) 0/.6rem 100% no-repeat,
  linear-gradient(to left, var(--shade), transparent) 100%/.6rem 100% no-repeat }
@media screen and (max-width: 50rem) {
  th, td { padding: .2rem .35rem } th.n { white-space: normal }
  .wide:not(.stacks) td:first-child:not(.n) { overflow-wrap: anywhere }
  .wide:not(.stacks) td:first-child:nth-last-child(-n+3):not(.n) { min-width: 4.8rem }
  .wide:not(.stacks) :is(th, td):first-child { position: sticky; left: 0;
    background: var(--paper) }
  .stacks thead { display: none } .stacks :is(table, tbody) { display: block }
  .stacks tr { display: grid; grid-template-columns: repeat(auto-fill, minmax(6.6rem, 1fr));
    border-bottom: 1px solid var(--line); padding: .4rem 0 }
  .stacks td { display: block; border: 0; padding: .1rem .6rem .1rem 0; text-align: left;
    overflow-wrap: anywhere; white-space: normal }
  .stacks :is(td:first-child, .long) { grid-column: 1 / -1 }
  .stacks td::before { content: attr(data-heading); display: block; color: var(--quiet);
    font-size: 11px }
  .stacks td:empty { display: none }
  .stacks td:is(:first-child, [data-heading=""])::before { display: none } }
img { max-width: 100% } summary { cursor: pointer; margin: 1rem 0 }
summary > h3 { display: inline }
pre { background: var(--code); padding: .6rem; overflow-x: auto; font-size: 12px }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #ddd; --paper: #121212; --quiet: #999; --line: #383838; --code: #1e1e1e;
    --pass: #6cc785; --fail: #ff8a80; --shade: #fff3 }
  img, .plot, .scale { filter: invert(.93) hue-rotate(180deg) } }
"""
"""In the dark, pictures and plots are turned over: light becomes dark, and each hue stays."""


MAX_WIDTH = 44
"""Characters, with one between columns, of a row that fits on a phone; wider rows become cards."""
LONG = 18
"""Characters from which on a cell has a line of its own on such a card."""

_WHOLE = re.compile(r"(?<!\S)--?[a-z][\w-]*|(?<= )[\d.]+e-\d+(?= )")
"""Options and small numbers, which browsers would break after a hyphen."""


def escaped(text: str) -> str:
    """Return the text escaped for an element or a quoted attribute."""
    return escape(printable(text))


def rendered(table: Table) -> str:
    """Return the table as HTML: on a phone the rows of a wide one are cards."""
    has_headings = any(column.heading for column in table.columns)
    stacks = has_headings and _min_width(table) > MAX_WIDTH
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


def write_page(
    path: Path,
    title: str,
    parts: Sequence[str],
    scripts: Sequence[str] = (),
    style: str = "",
    *,
    images_beside: bool = False,
) -> None:
    """Write a page with a title and parts of HTML; HarnessError when it cannot be written.

    It loads nothing but, with `images_beside`, images in its folder, and runs no other scripts than
    those given.
    """
    images = "data: 'self' file:" if images_beside else "data:"
    policy = f"default-src 'none'; img-src {images}; style-src 'unsafe-inline'{_allowed(scripts)}"
    page = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
        '<link rel="icon" href="data:,">',
        f"<title>{escaped(title)}</title><style>{_STYLE}{style}</style></head><body>",
        f"<h1>{escaped(title)}</h1>",
        *parts,
        *(f"<script>{script}</script>" for script in scripts),
        "</body></html>",
    ]
    with replacing(path) as temporary:
        temporary.write_text("\n".join(page) + "\n", encoding="utf-8", errors="replace")


def _allowed(scripts: Sequence[str]) -> str:
    """Return the part of a content security policy that allows these scripts."""
    digests = [base64.b64encode(sha256(script.encode()).digest()).decode() for script in scripts]
    return "; script-src " + " ".join(f"'sha256-{one}'" for one in digests) if digests else ""


def _min_width(table: Table) -> int:
    """Return the characters of the narrowest row, with one for each column; numbers keep a line."""
    whole = [row for row in table.cells if len(row) == len(table.columns)]
    return sum(
        1
        + max(
            [_longest_word(column.heading), *(_min_cell_width(row[index], column) for row in whole)]
        )
        for index, column in enumerate(table.columns)
    )


def _min_cell_width(cell: Cell, column: Column) -> int:
    return len(cell.text) if column.numeric else _longest_word(cell.text)


def _longest_word(text: str) -> int:
    return max(map(len, re.split(r"[\s_]+", text)))


def _row(row: Sequence[Cell], columns: Sequence[Column], stacks: bool) -> str:
    if len(row) < len(columns):
        return f'<td colspan="{len(columns)}">{_text(row[0], wrapped=True)}</td>'
    pairs = zip(row, columns, strict=True)
    return "".join(_element("td", cell, column, stacks) for cell, column in pairs)


def _element(tag: str, cell: Cell, column: Column, stacks: bool = False) -> str:
    """Return a cell; one of a table that stacks carries its heading."""
    kinds = ["n"] if column.numeric else ["lines"] if "\n" in cell.text else []
    kinds += ["long"] if stacks and len(cell.text) > LONG else []
    kind = f' class="{" ".join(kinds)}"' if kinds else ""
    heading = f' data-heading="{escaped(column.heading)}"' if stacks else ""
    return f"<{tag}{kind}{heading}>{_text(cell, wrapped=not column.numeric)}</{tag}>"


def _text(cell: Cell, *, wrapped: bool) -> str:
    text = escaped(cell.text)
    if wrapped:
        text = _WHOLE.sub(r'<span class="lines">\g<0></span>', text)
    text = text.replace("\n", "<br>")
    if cell.target:
        text = f'<a href="#{escaped(cell.target)}">{text}</a>'
    return text if cell.style is Style.PLAIN else f'<span class="{cell.style.value}">{text}</span>'
