"""Whether repetitions of a validation agree."""

from __future__ import annotations

from dataclasses import replace

from slider_resonator.checks.repeated import repeated
from tests.harness.verdicts import BAD, BROKEN, CRASH, GOOD, NONE, PASSED


def test_runs_that_agree() -> None:
    one = repeated([GOOD, replace(GOOD, wall_time=9.0)])
    assert one.worst is GOOD
    assert one.sentence == "good.fmu: of 2 runs 2 passed; the same numbers in all"


def test_the_first_of_the_worst_runs_is_kept() -> None:
    failed = replace(GOOD, checks=(replace(PASSED, passed=False),))
    assert repeated([GOOD, failed, GOOD]).worst is failed
    crashed = replace(GOOD, run_failures=(CRASH,))
    one = repeated([GOOD, failed, crashed, crashed])
    assert one.worst is crashed
    assert one.verdicts == (1, 1, 2)
    assert "1 passed, 1 failed, 2 could not be run" in one.sentence
    assert repeated([BAD, BAD]).worst is BAD
    assert repeated([BROKEN]).worst is BROKEN


def test_other_numbers_are_named_even_where_all_pass() -> None:
    other = replace(GOOD, checks=(replace(PASSED, deviation=2e-10),))
    one = repeated([GOOD, GOOD, other])
    assert one.verdicts == (3, 0, 0)
    assert one.sentence.endswith("; other numbers in phase_sweep: steady_velocity")


def test_what_is_no_number_is_the_same_as_itself() -> None:
    lost = replace(GOOD, checks=(replace(NONE, fmu=float("nan"), deviation=float("nan")),))
    again = replace(GOOD, checks=(replace(NONE, fmu=float("nan"), deviation=float("nan")),))
    assert repeated([lost, again]).unsteady == ()
