from __future__ import annotations

from dataclasses import replace

from slider_resonator.checks.reports.headline import headline
from tests.harness.verdicts import PASSED

MINE = replace(PASSED, scene="mine", at={}, against="located_events", fmu=0.1, reference=0.2)
TABLE_1 = replace(MINE, scene="table_1", fmu=0.126667, reference=0.126667, deviation=2e-10)
THEORY = replace(TABLE_1, against="closed_form", reference=0.12673, deviation=6.3e-5, passed=False)


def test_table_1_answers_before_the_scenes_of_the_user() -> None:
    ((heading, rows),) = headline([MINE, TABLE_1, THEORY])
    assert heading.text == "steady velocity: table_1"
    texts = [[cell if isinstance(cell, str) else cell.text for cell in row] for row in rows]
    assert texts == [
        ["FMU", "0.126667 m/s", "", ""],
        ["reference", "0.126667 m/s", "off by 2.0e-10 m/s", "pass"],
        ["paper's theory", "0.12673 m/s", "off by 6.3e-05 m/s", "FAIL"],
    ]


def test_a_bound_or_a_value_is_no_answer() -> None:
    other = [replace(MINE, against="at least"), replace(MINE, against="value")]
    assert not list(headline(other))


def test_an_fmu_without_steady_motion_gives_none() -> None:
    ((_, rows),) = headline([replace(MINE, fmu=None, deviation=None, passed=False)])
    assert rows[0] == ("FMU", "none", "", "")
