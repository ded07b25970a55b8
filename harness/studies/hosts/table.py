"""The host table: Markdown that a page holds between two marks."""

from collections.abc import Sequence

from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts
from studies.hosts.runs import CASES, HostComparison, HostResult

BEGIN, END = "<!-- hosts -->", "<!-- end of hosts -->"
COLUMNS = (*texts("host", "version", "FMU"), *numbers(*(case.title for case in CASES)))


def host_table(results: Sequence[HostResult]) -> Table:
    """Return the table: a row for each FMU in each host, the largest deviation for each case."""
    rows: list[Row] = [
        (result.host, result.version, result.fmu, *(_cell(result.comparisons[c]) for c in CASES))
        for result in results
    ]
    return Table(COLUMNS, rows)


def _cell(comparison: HostComparison) -> Cell:
    text = "failed"
    if comparison.deviation is not None:
        text = f"{comparison.deviation:.0e}" if comparison.deviation else "0"
    return Cell(text, Style.PLAIN if comparison.passed else Style.FAIL)
