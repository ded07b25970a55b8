"""Tables and foreign text in Markdown, as GitHub renders it."""

import re

from slider_resonator.output.readable import printable
from slider_resonator.output.table import Cell, Style, Table

_MARKUP = re.compile(r"[\\`*|~$]|(?<![^\W_])_|_(?![^\W_])|(?<=\])\(")
"""Characters with a meaning; an underscore inside a word and a bracket by itself have none."""

_ADDRESS = re.compile(r":(?=//)|(?<=www)\.|@", re.IGNORECASE)
"""What makes a link of an address that stands by itself."""


def escaped(text: str) -> str:
    """Return the text escaped for one line of Markdown or a cell of a table."""
    html = printable(text).replace("&", "&amp;").replace("<", "&lt;")
    html = _ADDRESS.sub(lambda found: f"&#{ord(found[0])};", html)
    return "<br>".join(_MARKUP.sub(r"\\\g<0>", html).splitlines())


def rendered(table: Table) -> str:
    """Return the table as lines of Markdown, without a newline at the end."""
    rules = ["---:" if column.numeric else "---" for column in table.columns]
    lines = [_line([escaped(column.heading) for column in table.columns]), _line(rules)]
    for row in table.cells:
        lines.append(_line([_text(cell) for cell in row] + [""] * (len(rules) - len(row))))
    return "\n".join(lines)


def _text(cell: Cell) -> str:
    strong = cell.style in (Style.FAIL, Style.HEADING)
    return f"**{escaped(cell.text)}**" if strong else escaped(cell.text)


def _line(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"
