"""Results of a trade: fronts, the cheapest, tables and pages."""

import re
from dataclasses import replace
from html import unescape
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.trading.page import draw_picture, write_trades
from slider_resonator.trading.result import (
    AVERAGED,
    BEGIN,
    CHOICE_COLUMNS,
    END,
    NEEDS,
    PEER,
    RESOLVED,
    Omission,
    Row,
    Trade,
    cheapest,
    choices,
    comparisons,
    duration,
    front,
    standings,
    write_choices,
)
from tests.harness.golden import assert_as_before, assert_page_as_before
from tests.harness.known_provenance import PROVENANCE


def row(
    cost: float, error: float, kind: str = RESOLVED, quantity: str = "position", family: str = "any"
) -> Row:
    setting = "tol 1e-06" if kind == PEER else "steps of 10 periods"
    cpu = (0.9 * cost, cost, 1.2 * cost)
    errors = {quantity: error}
    return Row(kind, family, f"{family}, {setting}", 0, periods=10, cpu=cpu, errors=errors)


sizes = st.floats(1e-11, 1e3)


@given(st.lists(st.tuples(sizes, sizes), min_size=1, max_size=12))
def test_no_row_beats_the_front(points: list[tuple[float, float]]) -> None:
    rows = [row(*point) for point in points]
    best = front(rows, "position")
    for one in rows:
        in_front = any(
            b.cost <= one.cost and b.errors["position"] <= one.errors["position"] for b in best
        )
        assert in_front, "each row is on the front or beaten by one that is"
    costs = [b.cost for b in best]
    wrong = [b.errors["position"] for b in best]
    assert costs == sorted(costs)
    assert wrong == sorted(wrong, reverse=True)
    assert len(set(wrong)) == len(wrong)


def test_the_cheapest_that_is_exact_enough() -> None:
    rows = [row(1.0, 1e-2), row(3.0, 1e-9), row(9.0, 1e-12)]
    assert cheapest(rows, "position", 1e-9) is rows[1]
    assert cheapest(rows, "position", 1e-13) is None
    assert cheapest(rows, "velocity", 1.0) is None, "none of them has a velocity"


def test_another_friction_law_is_no_candidate() -> None:
    lucky = replace(row(1e-6, 1e-12), friction_law=1)
    trade = Trade("s", "S", 0, 10, 1.0, (row(3e-4, 1e-13), lucky), ())
    (found,) = [s.row for s in standings(trade) if s.quantity == "position" and s.row is not None]
    assert found.friction_law == 0
    assert lucky in trade.having("position"), "its error is shown all the same"


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(2.0, "2 s"), (1.5e-3, "1.5 ms"), (9.996e-4, "1 ms"), (9.994e-4, "999 us"), (4e-8, "40 ns")],
)
def test_durations_are_readable(seconds: float, words: str) -> None:
    assert duration(seconds) == words


REPOSITORY = Path(__file__).parents[3]
PAGE = REPOSITORY / "docs" / "how-to-choose.md"
HEAD = tuple(column.heading for column in CHOICE_COLUMNS)
DOCUMENTATION = REPOSITORY / "fmu_src" / "assets" / "choosing.html"


TRADE = Trade(
    scene="s",
    title="S",
    friction_law=0,
    periods=10,
    simulated=1.0,
    rows=(
        row(2e-5, 3e-3, AVERAGED, family="native FMU, fidelity 0"),
        row(3e-4, 1e-13, family="native FMU, fidelity 2"),
        row(1e-2, 1e-13, family="Python FMU, fidelity 2"),
        row(1e-9, 1e-13, family="Python FMU, fidelity 1"),
        row(4e-3, 1e-6, PEER, family="heyoka"),
    ),
    omissions=(),
)


COMPARED = (
    row(1e-5, 1e-3, AVERAGED, "mean_velocity"),
    row(3e-4, 1e-13, RESOLVED, "mean_velocity"),
    row(6e-3, 1e-10, PEER, "mean_velocity"),
    row(1e-5, 1e-3, AVERAGED),
    row(3e-4, 1e-13, RESOLVED),
    row(6e-3, 1e-8, PEER),
)


def test_classes_are_compared_and_the_native_fmu_decides_the_model() -> None:
    """Where they reach an error. A cheaper FMU of FMI 3.0 changes nothing."""
    compared = comparisons(replace(TRADE, rows=COMPARED))
    said = [f"{target}: {words}\n" for target, sentences in compared for words in sentences]
    rough = replace(TRADE, rows=TRADE.rows[:1])
    for title, trade in (("Choices", TRADE), ("A need that no method meets", rough)):
        said += [f"{title}\n", *(f"{' | '.join(one)}\n" for one in choices(trade))]
    assert_as_before("trade_choices.txt", "".join(said))
    fmi3 = row(1e-5, 1e-13, family="native SliderResonator3.fmu FMU, fidelity 2")
    assert choices(replace(TRADE, rows=(*TRADE.rows, fmi3))) == choices(TRADE)


def test_markdown_and_html_hold_the_same(tmp_path: Path) -> None:
    paths = [tmp_path / "page.md", tmp_path / "page.html"]
    for path in paths:
        path.write_text(f"before\n{BEGIN}\nold\n{END}\nafter\n")
        write_choices(path, [TRADE])
    assert tables(paths[0]) == tables(paths[1])
    assert all("old" not in path.read_text() for path in paths)


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


def test_a_page_stands_alone(tmp_path: Path) -> None:
    gone = Omission("s", "slow <method>", "all", "more than its budget")
    trade = replace(TRADE, title="A & B", omissions=(gone,))
    write_trades(tmp_path / "index.html", [trade], PROVENANCE)
    assert_page_as_before("trade.html", tmp_path / "index.html")


def test_the_picture_is_drawn_where_a_quantity_is_missing_too(tmp_path: Path) -> None:
    draw_picture(TRADE, tmp_path / "trade.png")
    assert (tmp_path / "trade.png").read_bytes().startswith(b"\x89PNG")
