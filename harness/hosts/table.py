"""The host table: Markdown that a README holds between two marks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from harness.atomic import replacing
from harness.errors import HarnessError
from harness.hosts.runs import CASES, Comparison, HostResult

BEGIN, END = "<!-- hosts -->", "<!-- end of hosts -->"
HEAD = ("host", "version", "FMU", *(case.title for case in CASES))


def host_table(results: Sequence[HostResult]) -> str:
    """Return the table: a row for each FMU in each host, the largest deviation for each case."""
    lines = [_line(HEAD), _line(["---"] * len(HEAD))]
    for result in results:
        cells = [_cell(result.comparisons[case]) for case in CASES]
        lines.append(_line([result.host, result.version, result.fmu, *cells]))
    return "\n".join(lines)


def write_table(path: Path, table: str) -> None:
    """Write the table to `path`; between the marks, and nowhere else, where the file has them.

    Raises HarnessError when the file cannot be read or written, or has only one of the marks.
    """
    text = table + "\n"
    if path.exists():
        try:
            before = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise HarnessError(f"{path}: cannot be read: {error}") from error
        if BEGIN in before or END in before:
            text = embedded(before, table, path)
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def embedded(text: str, table: str, path: Path) -> str:
    """Return `text` with the table between the marks; HarnessError where they are no pair."""
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise HarnessError(f"{path}: allowed is one {BEGIN} and one {END} after it")
    head, _, rest = text.partition(BEGIN)
    _, _, tail = rest.partition(END)
    return f"{head}{BEGIN}\n{table}\n{END}{tail}"


def shown(comparison: Comparison) -> str:
    """Return the deviation with one digit, or that there is none."""
    if comparison.deviation is None:
        return "failed"
    return f"{comparison.deviation:.0e}" if comparison.deviation else "0"


def _cell(comparison: Comparison) -> str:
    return shown(comparison) if comparison.passed else f"**{shown(comparison)}**"


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"
