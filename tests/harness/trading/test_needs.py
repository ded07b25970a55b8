"""From need to model: the tables of the page and of the FMU's documentation."""

from __future__ import annotations

import re
from dataclasses import replace
from html import unescape
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.trading.result import AVERAGED, PEER, RESOLVED, Row, Trade
from slider_resonator.trading.summary import (
    BEGIN,
    COLUMNS,
    END,
    NEEDS,
    choices,
    write_choices,
)
from tests.harness.trading.test_result import row

REPOSITORY = Path(__file__).parents[3]
PAGE = REPOSITORY / "docs" / "how-to-choose.md"
HEAD = tuple(column.heading for column in COLUMNS)
DOCUMENTATION = REPOSITORY / "fmu_src" / "assets" / "choosing.html"


def named(row: Row, family: str, setting: str) -> Row:
    return replace(row, family=family, method=f"{family}, {setting}")


TRADE = Trade(
    scene="s",
    title="S",
    friction_law=0,
    periods=10,
    simulated=1.0,
    rows=(
        named(row(2e-5, 3e-3, AVERAGED), "native FMU, fidelity 0", "steps of 10 periods"),
        named(row(3e-4, 1e-13, RESOLVED), "native FMU, fidelity 2", "steps of 10 periods"),
        named(row(1e-2, 1e-13, RESOLVED), "Python FMU, fidelity 2", "steps of 10 periods"),
        named(row(1e-9, 1e-13, RESOLVED), "Python FMU, fidelity 1", "steps of 10 periods"),
        named(row(4e-3, 1e-6, PEER), "heyoka", "tol 1e-06"),
    ),
    omissions=(),
)


def test_the_native_fmu_decides_the_model() -> None:
    found = {row[:2]: row for row in choices(TRADE)}
    assert found["position", "1e-02"] == (
        *("position", "1e-02", "fidelity 0, steps of 10 periods", "3e-03", "20 us / s"),
        *("not reached", "4 ms / s (heyoka, tol 1e-06)"),
    )
    assert found["position", "1e-09"] == (
        *("position", "1e-09", "fidelity 2, steps of 10 periods", "1e-13", "300 us / s"),
        *("10 ms / s", "not reached"),
    )
    assert {quantity for quantity, _ in found} == {"position"}, "the scene has nothing else"


def test_a_model_that_falls_short_in_the_python_fmu_is_not_its_answer() -> None:
    held = replace(TRADE.rows[2], errors={"position": 1e-3})
    found = {row[1]: row for row in choices(replace(TRADE, rows=(*TRADE.rows[:2], held)))}
    assert found["1e-09"][2:6] == (
        "fidelity 2, steps of 10 periods",
        "1e-13",
        "300 us / s",
        "not reached",
    )


def test_a_need_that_no_method_meets_is_shown(tmp_path: Path) -> None:
    rough = replace(TRADE, rows=TRADE.rows[:1])
    (_, _, exact) = choices(rough)
    assert exact[2:] == ("none", "", "not reached", "not reached", "not reached")


def test_markdown_and_html_hold_the_same(tmp_path: Path) -> None:
    paths = [tmp_path / "page.md", tmp_path / "page.html"]
    for path in paths:
        path.write_text(f"before\n{BEGIN}\nold\n{END}\nafter\n")
        write_choices(path, [TRADE])
    assert tables(paths[0]) == tables(paths[1])
    assert all("old" not in path.read_text() for path in paths)
    with pytest.raises(HarnessError, match=r"the suffix is '\.txt'; must be \.md or \.html"):
        write_choices(tmp_path / "page.txt", [TRADE])


def tables(path: Path) -> list[list[str]]:
    """Return the rows between the marks, without heads."""
    text = path.read_text(encoding="utf-8").partition(BEGIN)[2].partition(END)[0]
    if path.suffix == ".md":
        lines = [line for line in text.splitlines() if line.startswith("| ")]
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    else:
        lines = re.findall(r"<tr>(.*?)</tr>", text)
        rows = [
            [unescape(cell) for cell in re.findall(r"<t[hd].*?>(.*?)</t[hd]>", line)]
            for line in lines
        ]
    return [row for row in rows if tuple(row) != HEAD and row[0] != "---"]


def test_committed_tables_were_written_by_this_code() -> None:
    rows = tables(PAGE)
    assert rows == tables(DOCUMENTATION), "the page and the FMU's documentation agree"
    needs = {(quantity.replace("_", " "), f"{error:.0e}") for quantity, error in NEEDS}
    assert needs == {(row[0], row[1]) for row in rows}, "each need is met in some scene, or not"
    assert all(len(row) == len(HEAD) for row in rows)
