from __future__ import annotations

import io
from dataclasses import replace

from rich.console import Console

from slider_resonator.checks.compare import Check
from slider_resonator.checks.reports.terminal import print_validation
from slider_resonator.checks.validate import Validation
from slider_resonator.output.console import LOG_WIDTH
from slider_resonator.scenes.vocabulary import QUANTITIES
from tests.harness.verdicts import NONE, PASSED, WORD

BAD = replace(NONE, reference=0.15, note="no steady motion")

LONG = "load_above_friction"
FARTHEST = replace(PASSED, deviation=1.2e-10, allowed=1.3e-07, at={"phase": 2.4083})
FORCE, LENGTH = -1.2345678e-05, 0.00012345678
WIDEST = (
    replace(WORD, scene="table_1_high_frequency", fmu=LONG, reference=LONG, passed=True),
    replace(
        FARTHEST,
        quantity="predicted_blocking_force",
        unit="N",
        against="at least",
        fmu=FORCE,
        reference=FORCE,
    ),
    replace(FARTHEST, quantity="resonator_displacement", unit="m", fmu=LENGTH, reference=LENGTH),
)


def printed(*checks: Check, details: bool = False, fmu: str = "my.fmu") -> str:
    console = Console(file=io.StringIO(), width=LOG_WIDTH)
    print_validation(console, Validation(fmu, checks, 1.5), details=details)
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


def test_the_summary_is_one_line_with_the_file_name() -> None:
    fmu = f"a{'/very' * 40}/long/path[old].fmu"
    assert printed(PASSED, fmu=fmu).splitlines()[-1] == f"{fmu}: 1 of 1 checks passed in 1.5 s"


def test_the_longest_rows_fit_a_log_unwrapped() -> None:
    text = printed(*WIDEST)
    assert len(text.splitlines()) == 2 + 1 + 2 + 1 + 3 + 3, text
    assert "predicted_blocking_force, N" in text
    assert "resonator_displacement*, m" in text
    assert "* the peak of a signal" in text
    assert text.count("load_above_friction") == 2


def test_what_an_fmu_gives_cannot_command_the_terminal() -> None:
    text = printed(replace(PASSED, fmu="\x1b[2Jstuck", passed=False), fmu="\x1b[31m.fmu")
    assert "\x1b" not in text
    assert "\ufffd[2Jstuck" in text
    assert "\ufffd[31m.fmu: 1 failed, 0 of 1 checks passed" in text


def test_minus_zero_and_noise_are_0() -> None:
    (row,) = [
        line
        for line in printed(replace(PASSED, fmu=-0.0, reference=-1.7e-14)).splitlines()
        if "steady_velocity" in line
    ]
    assert row.split()[4:6] == ["0", "0"], row


def test_of_a_sweep_the_worst_point_is_shown_with_its_reason() -> None:
    text = printed(PASSED, BAD)
    assert "phase_sweep, 2 points" in text
    assert "worst at" in text
    assert text.count("phase 0.4") == 2, "in the table and as a failure"
    assert "phase 0 " not in text
    assert "FAIL phase_sweep: steady_velocity at phase 0.4: both must agree" in text
    assert "no steady motion" in text
    assert "1 failed" in text


def test_details_show_every_point_and_why() -> None:
    text = printed(PASSED, BAD, details=True)
    assert "phase 0 " in text
    assert text.count("both must agree") >= 2
    many = printed(*(replace(PASSED, scene=f"scene_{n}") for n in range(9)), details=True)
    assert many.count("both must agree") == 9, "of many scenes too"


def test_many_scenes_have_a_line_each_and_their_failures_in_full() -> None:
    good = [replace(PASSED, scene=f"scene_{n}", why=f"reason {n}") for n in range(9)]
    near = replace(PASSED, scene="scene_0", quantity="blocking_force", deviation=0.9e-7)
    text = printed(*good, near, replace(BAD, scene="scene_9"))
    rows = [line.split() for line in text.splitlines() if " of " in line and "pass" in line[-6:]]
    assert len(rows) == 9, "one line a scene"
    assert rows[0][:-2] == ["scene_0", "2", "of", "2", "blocking_force", "9.0e-08", "1.0e-07"]
    assert rows[0][-2:] == ["m/s", "pass"]
    assert "FAIL scene_9: steady_velocity at phase 0.4: both must agree" in text
    assert text.count("steady_velocity") == 9 + 2, "a line each, and two of what fails"
    assert "10 of 11 checks passed" in text
    assert "reason" not in text


def test_of_hundreds_of_scenes_those_that_fail_or_come_nearest_have_a_line() -> None:
    good = [replace(PASSED, scene=f"scene_{n}", deviation=n * 1e-10) for n in range(285)]
    text = printed(replace(BAD, scene="scene_bad"), *good)
    rows = [line.split()[0] for line in text.splitlines() if " of 1 " in line]
    assert rows == ["scene_bad", *(f"scene_{n}" for n in range(274, 285))]
    assert "274 more scenes passed, none nearer to a bound (--details lists all)" in text
    assert "285 of 286 checks passed" in text


def test_of_hundreds_of_failures_the_worst_of_the_first_scenes_are_shown() -> None:
    bad = replace(PASSED, deviation=1e-3, passed=False)
    worse = replace(bad, quantity="blocking_force", deviation=1e-2)
    text = printed(*(replace(one, scene=f"scene_{n}") for n in range(285) for one in (bad, worse)))
    rows = [line.split()[0] for line in text.splitlines() if "0 of 2 " in line]
    assert rows == [f"scene_{n}" for n in range(12)]
    assert "273 more scenes failed (--details lists all)" in text
    failures = [line for line in text.splitlines() if line.startswith("FAIL scene_")]
    assert len(failures) == 24
    assert failures[23].startswith("FAIL scene_23: blocking_force"), "the worst of each"
    assert "546 more checks failed (--details lists all)" in text
    assert "570 failed, 0 of 570 checks passed" in text
    few = printed(*(replace(bad, quantity=name) for name in QUANTITIES))
    assert "more checks failed" not in few, "of few scenes all are shown"
