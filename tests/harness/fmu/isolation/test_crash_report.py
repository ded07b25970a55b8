import pytest

from slider_resonator.fmu.isolation.crash_report import crash_report, missed_limit
from slider_resonator.fmu.isolation.supervised import Ending
from slider_resonator.fmu.limits import MEMORY

TRACE = (
    "Fatal Python error: Aborted\n\nCurrent thread 0x1 (most recent call first):\n"
    '  File "/a/fmpy/fmi2.py", line 12 in doStep\n'
    '  File "/a/fmu/instance.py", line 107 in step_to\n'
    '  File "/a/fmu/run.py", line 219 in run\n'
)


def test_a_crash_names_the_call_and_the_signal() -> None:
    assert crash_report("stepping\n", TRACE, Ending(-6), 60.0) == (
        "the FMU crashed in fmi2DoStep: its process ended with SIGABRT; it printed: stepping"
    )


def test_a_missed_time_limit_is_reported_however_the_process_ended() -> None:
    trace = TRACE.replace("Fatal Python error: Aborted", "Timeout (0:01:00)!")
    expected = "no answer within the time limit of 60 s in fmi2DoStep: the FMU was ended"
    assert crash_report("", trace, Ending(1), 60.0) == expected
    assert crash_report("", "", Ending(None), 60.0) == expected.replace(" in fmi2DoStep", "")
    assert missed_limit(trace, Ending(1))
    assert missed_limit(trace, Ending(-11)), "it crashed while it wrote the trace"
    assert missed_limit("", Ending(None))


def test_printed_text_is_not_taken_for_a_traceback() -> None:
    printed = TRACE.replace("Fatal Python error: Aborted", "Timeout (0:01:00)!")
    assert crash_report(printed, "", Ending(1), 60.0).startswith(
        "the FMU crashed: its process ended with exit code 1; it printed: Timeout"
    )


@pytest.mark.parametrize(
    ("ending", "what"),
    [
        (Ending(memory=400 * 2**20), "400 MiB in memory; must be at most 300 MiB (--max-memory)"),
        (Ending(processes=321), "321 processes; must be at most 250"),
    ],
)
def test_exceeded_limits(ending: Ending, what: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(MEMORY, "300")
    assert not missed_limit("", ending)
    assert crash_report("", "", ending, 60.0) == f"the FMU was ended: it had {what}"
