"""What is asked first: the steady velocity and the blocking force, in physical units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from slider_resonator.checks.compare import Check, Value
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


def headline(checks: Sequence[Check]) -> list[tuple[Cell, list[Row]]]:
    """Return for each question that the checks answer its heading and rows.

    A row has a name, a value with its unit, and for a reference how far the FMU is off and whether
    that is allowed. A scene of the user answers where the built-in one was not run.
    """
    answers = [_answer(quantity, checks) for quantity in QUESTIONS]
    return [answer for answer in answers if answer is not None]


def _answer(quantity: str, checks: Sequence[Check]) -> tuple[Cell, list[Row]] | None:
    name, scene = QUESTIONS[quantity]
    found = [c for c in checks if c.quantity == quantity and c.against in ANSWERS]
    if not found:
        return None
    first = min(found, key=lambda check: check.scene != scene)
    same = [c for c in found if (c.scene, c.at) == (first.scene, first.at)]
    rows: list[Row] = [("FMU", _value(first.fmu, first.unit), "", "")]
    for against, called in ANSWERS.items():
        for check in [c for c in same if c.against == against][:1]:
            off = "" if check.deviation is None else f"off by {check.deviation:.1e} {check.unit}"
            value = _value(check.reference, check.unit)
            rows.append((called, value, off, verdict(check.passed)))
    where = f"{first.scene}{place(first.at, ', ')}"
    return Cell(f"{name}: {where}", Style.HEADING), rows


def _value(value: Value, unit: str) -> str:
    shown = value_text(value, DIGITS)
    return f"{shown} {unit}" if isinstance(value, float | int) else shown
