from __future__ import annotations

from rich.console import Console

from studies.mutants.native.change_verdict import ChangeVerdict, NativeRun
from studies.mutants.native.changes import Change
from studies.mutants.native.listing import print_native_run, summary

VERDICTS = (
    ChangeVerdict(Change("seen", "a.c", "x", "y", "breaks it"), True, "scene", "position", "off"),
    ChangeVerdict(Change("unseen", "a.c", "x", "y", "breaks that"), False),
    ChangeVerdict(Change("hidden", "b.c", "x", "y", "nothing", survives="rounding"), False),
    ChangeVerdict(
        Change("fine", "b.c", "x", "[y]", "harmless", harmless=True), True, "s", "velocity", "off"
    ),
)
RUN = NativeRun("x.fmu", VERDICTS, 12.3)


def test_the_summary_counts_what_a_scene_can_see() -> None:
    assert summary(RUN) == (
        "x.fmu: rejected 1 of the 2 faults that a scene can see: 50.00%; 1 others have a reason; "
        "rejected 1 of 1 harmless variants (12 s)"
    )


def test_survivors_and_false_alarms_are_printed_with_reasons() -> None:
    console = Console(width=100, record=True)
    print_native_run(console, RUN)
    text = console.export_text()
    assert "SURVIVED a.c: unseen" in text
    assert "EXPLAINED b.c: hidden" in text
    assert "rounding" in text
    assert "FALSE ALARM b.c: fine" in text
    assert "s: velocity: off" in text
    assert "+[y]" in text
    assert "seen\n" not in text.replace("unseen\n", "")
