from __future__ import annotations

import io

from rich.console import Console

from harness.compare import Check
from harness.report import print_validation
from harness.validate import Validation

GOOD = Check(
    *("phase_sweep", "steady_velocity", "m/s", 0.126667, "located_events", 0.126667),
    *(1e-10, 1e-7, True, "both must agree", "", {"phase": 0.0}),
)
BAD = Check(
    *("phase_sweep", "steady_velocity", "m/s", None, "located_events", 0.15),
    *(None, None, False, "both must agree", "no steady motion", {"phase": 0.4}),
)


def printed(*checks: Check, details: bool = False) -> str:
    console = Console(file=io.StringIO(), width=180)
    print_validation(console, Validation("my.fmu", checks, 1.5), details=details)
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


def test_the_table_shows_units_and_the_summary() -> None:
    text = printed(GOOD)
    assert "steady_velocity [m/s]" in text
    assert "located events" in text
    assert "1 of 1 checks passed" in text
    assert "FAIL" not in text


def test_of_a_sweep_the_worst_point_is_shown_with_its_reason() -> None:
    text = printed(GOOD, BAD)
    assert "phase = 0.4, worst of 2" in text
    assert "phase = 0," not in text
    assert "FAIL phase_sweep: steady_velocity at phase = 0.4: both must agree" in text
    assert "no steady motion" in text
    assert "1 failed" in text


def test_details_show_every_point_and_why() -> None:
    text = printed(GOOD, BAD, details=True)
    assert "phase = 0 " in text
    assert text.count("both must agree") >= 2
