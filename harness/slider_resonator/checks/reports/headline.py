"""What is asked first: the steady velocity and the blocking force, in physical units."""

from collections.abc import Iterator, Mapping, Sequence

from slider_resonator.checks.compare import Check
from slider_resonator.checks.verdict import place, value_text
from slider_resonator.output.table import Cell, Row, Style, verdict

QUESTIONS: Mapping[str, tuple[str, str]] = {
    "steady_velocity": ("steady velocity", "table_1"),
    "blocking_force": ("blocking force", "blocking_force"),
}
"""Quantities, each with its name and the built-in scene that answers first."""
ANSWERS: Mapping[str, str] = {"located_events": "reference", "closed_form": "paper's theory"}
"""References, by what they are called here."""
DIGITS = 7


def headline(checks: Sequence[Check]) -> Iterator[tuple[Cell, list[Row]]]:
    """Yield for each question that the checks answer its heading and rows.

    A row has a name, a value with its unit, and for a reference how far the FMU is off and whether
    that is allowed. A scene of the user answers where the built-in one was not run.
    """
    for quantity, (name, scene) in QUESTIONS.items():
        found = [c for c in checks if c.quantity == quantity and c.against in ANSWERS]
        if not found:
            continue
        first = min(found, key=lambda check: check.scene != scene)
        rows: list[Row] = [("FMU", value_text(first.fmu, DIGITS, f" {first.unit}"), "", "")]
        answers = {
            c.against: c for c in reversed(found) if (c.scene, c.at) == (first.scene, first.at)
        }
        for against, called in ANSWERS.items():
            if check := answers.get(against):
                off = (
                    "" if check.deviation is None else f"off by {check.deviation:.1e} {check.unit}"
                )
                value = value_text(check.reference, DIGITS, f" {check.unit}")
                rows.append((called, value, off, verdict(check.passed)))
        yield Cell(f"{name}: {first.scene}{place(first.at, ', ')}", Style.HEADING), rows
