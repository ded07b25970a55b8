from __future__ import annotations

from slider_resonator.fmu.isolation.crash_report import crash_report

STACK = (
    "stepping\nFatal Python error: Aborted\n\nCurrent thread 0x1 (most recent call first):\n"
    '  File "/a/fmpy/fmi2.py", line 12 in doStep\n'
    '  File "/a/fmu/instance.py", line 107 in step_to\n'
    '  File "/a/fmu/run.py", line 219 in run\n'
)


def test_a_crash_names_the_call_and_the_signal() -> None:
    assert crash_report(STACK, -6, 60.0) == (
        "the FMU crashed in fmi2DoStep: its process ended with SIGABRT; it printed: stepping"
    )


def test_a_missed_time_limit_is_reported_however_the_process_ended() -> None:
    stack = STACK.replace("Fatal Python error: Aborted", "Timeout (0:01:00)!")
    expected = "no answer within the time limit of 60 s in fmi2DoStep: the FMU was ended"
    assert crash_report(stack, 1, 60.0).startswith(expected)
    assert crash_report("", None, 60.0) == expected.replace(" in fmi2DoStep", "")


def test_an_ending_without_a_trace_is_reported_by_its_code() -> None:
    assert crash_report("", 3, 60.0) == "the FMU crashed: its process ended with exit code 3"
