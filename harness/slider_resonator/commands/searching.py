"""What the commands that search by shooting have in common."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from slider_resonator.commands.options import (
    fmu_argument,
    json_option,
    max_denominator_option,
    set_option,
)
from slider_resonator.output.json_output import to_json
from slider_resonator.output.readable import readable
from slider_resonator.steady.search_result import SearchResult


def search_arguments(command: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the FMU and the options of a search."""
    for parameter in (json_option, max_denominator_option, set_option, fmu_argument):
        command = parameter(command)
    return command


def tell(outcome: SearchResult, what: str, value: float | None, unit: str, as_json: bool) -> int:
    """Print the outcome of a search and return the exit code: 1 where there is no value."""
    click.echo(to_json(outcome) if as_json else _sentences(outcome, what, value, unit))
    return 1 if value is None else 0


def _sentences(outcome: SearchResult, what: str, value: float | None, unit: str) -> str:
    found = "none" if value is None else f"{readable(value, 10)} {unit}"
    lines = [
        f"{what:<17}{found}",
        f"status           {outcome.status}: {outcome.reason}",
        f"averaged theory  {readable(outcome.predicted, 10)} {unit} (the FMU's own output)",
    ]
    if outcome.common_period is not None:
        lines.append(
            f"cost             {outcome.periods} drive periods in {outcome.iterations} iterations, "
            f"a common period is {outcome.common_period} of them"
        )
    if outcome.multipliers:
        sizes = ", ".join(f"{abs(multiplier):.6f}" for multiplier in outcome.multipliers)
        lines.append(f"multipliers      {sizes} (magnitudes)")
    return "\n".join(lines)
