"""Tables as data: written once, rendered for a terminal, in Markdown and in HTML."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum


class Style(Enum):
    """The meaning of a cell; each writer renders it in its own way."""

    PLAIN = "plain"
    PASS = "pass"
    FAIL = "fail"
    HEADING = "heading"
    NOTE = "note"


@dataclass(frozen=True)
class Column:
    """A column; one of numbers is right-aligned and not wrapped."""

    heading: str
    numeric: bool = False


@dataclass(frozen=True)
class Cell:
    """A text, which may have several lines, with a style.

    In a page it is a link to the element whose id is `target`, if any, and shows its `note` under
    the pointer.
    """

    text: str
    style: Style = Style.PLAIN
    target: str = ""
    note: str = ""


Row = Sequence[str | Cell]


@dataclass(frozen=True)
class Table:
    """Columns, and rows of one cell for each of them, or only the first one."""

    columns: Sequence[Column]
    rows: Sequence[Row]

    @property
    def cells(self) -> list[list[Cell]]:
        """All rows, with every text as a cell."""
        return [[c if isinstance(c, Cell) else Cell(c) for c in row] for row in self.rows]


def texts(*headings: str) -> list[Column]:
    """Return columns of text."""
    return [Column(heading) for heading in headings]


def numbers(*headings: str) -> list[Column]:
    """Return columns of numbers."""
    return [Column(heading, numeric=True) for heading in headings]


def verdict(passed: bool, not_run: int = 0) -> Cell:
    """Return the cell of a verdict on a run of which a number may be missing."""
    if passed and not_run:
        return Cell("incomplete", Style.NOTE)
    return Cell("pass", Style.PASS) if passed else Cell("FAIL", Style.FAIL)
