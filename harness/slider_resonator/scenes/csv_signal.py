"""Read CSV files: their rows, and a column over time."""

import codecs
import csv
import io
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from slider_resonator.device.signal import Signal, through
from slider_resonator.device.units import finite_number, scaled, si_number
from slider_resonator.errors import explained

_HEADING = re.compile(r"\s*(.*?)\s*[\[(]([^\])]*)[\])]\s*")


def _text(path: Path) -> str:
    """Return the text of a file in UTF-8, UTF-16 with its mark, or else Windows-1252."""
    content = path.read_bytes()
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return content.decode("utf-16")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252")


def csv_rows(path: Path) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """Return the header of a CSV file, and its other rows with their line numbers.

    Columns are apart by semicolons or tabs if the header has some, and numbers may then have a
    decimal comma; else by commas. Lines that begin with # and rows without a value are left out.
    Raises ValueError naming the file and what is wrong, also for a row that has more cells than the
    header.
    """
    try:
        file = io.StringIO(_text(path), newline="")
        lines = [(n, line) for n, line in enumerate(file, 1) if not line.startswith("#")]
        first = lines[0][1] if lines else ""
        separator = next((one for one in (";", "\t") if one in first), ",")
        reader = csv.reader((line for _, line in lines), delimiter=separator)
        read = ((lines[reader.line_num - 1][0], row) for row in reader)
        rows = [(line, row) for line, row in read if any(cell.strip() for cell in row)]
    except OSError as error:
        raise ValueError(f"csv {path} cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        must = "must be lines of numbers, in UTF-8, UTF-16 or Windows-1252"
        raise ValueError(f"csv {path}: {error}; {must}") from error
    header = [name.strip() for name in rows[0][1]] if rows else []
    if separator != ",":
        rows = [(line, [cell.replace(",", ".") for cell in row]) for line, row in rows]
    for line, row in rows[1:]:
        if any(cell.strip() for cell in row[len(header) :]):
            raise ValueError(
                f"csv {path} line {line}: {len(row)} cells below {len(header)} headings; "
                "must be as many (with decimal commas columns are apart by ;, text with commas "
                "is in quotes)"
            )
    return header, rows[1:]


def split_heading(heading: str) -> tuple[str, str]:
    """Return name and unit of a heading such as `phase [deg]`, "" where it has no unit."""
    match = _HEADING.fullmatch(heading)
    return (match[1], match[2]) if match else (heading, "")


def heading_factor(heading: str, unit: str) -> float:
    """Return the factor to the SI unit of a heading; ValueError for a unit of something else."""
    given = split_heading(heading)[1]
    return si_number(heading, f"1 {given}", unit) if given else 1.0


def csv_signal(path: Path, column: str, between: str, unit: str) -> Signal:
    """Return a column over time, of a file with the columns `time` and `column`, or `value`.

    Its values are in the SI `unit`, or in that of its heading. `between` its rows it is "hold" or
    "linear". Raises ValueError naming the file, the line and what is wrong.
    """
    header, rows = csv_rows(path)
    names = [split_heading(heading)[0] for heading in header]
    if not header or names[0] != "time":
        raise ValueError(
            f"csv {path}: the header is {header}: it must begin with 'time', then the values"
        )
    column = split_heading(column)[0]
    name = column if column in names else "value"
    if (count := names.count(name)) != 1:
        wanted = f"{count or 'no'} columns {column!r} or 'value'"
        raise ValueError(f"csv {path}: {wanted} among {', '.join(header[1:])}; must be one")
    index = names.index(name)
    with explained(f"csv {path}: heading ", ValueError):
        factors = heading_factor(header[0], "s"), heading_factor(header[index], unit)
    points = []
    for line, row in rows:
        try:
            time, value = csv_number("time", row, 0), csv_number(name, row, index)
            points.append((scaled(time, factors[0]), scaled(value, factors[1])))
        except ValueError as error:
            raise ValueError(f"csv {path} line {line}: {error}") from error
    with explained(f"csv {path}: ", ValueError):
        return replace(through(points, hold=between == "hold"), file=path)


def csv_number(name: str, row: Sequence[str], index: int) -> float:
    """Return the number in a column of a row; ValueError with name and text for any other."""
    return finite_number(name, row[index].strip() if index < len(row) else "")
