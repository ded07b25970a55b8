"""Arguments and output of the commands that search by shooting."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from slider_resonator.commands.options import (
    json_option,
    max_denominator_option,
    native_fmu_argument,
    set_option,
    time_limit_option,
)
from slider_resonator.commands.results import print_result
from slider_resonator.device.device import Device
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.provenance import Provenance
from slider_resonator.output.readable import number_of, readable
from slider_resonator.output.terminal import one_line
from slider_resonator.steady.search_result import SearchResult


def search_arguments(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the FMU and the options of a search to a command."""
    time_limit = time_limit_option(TIME_LIMIT, "For the whole search.")
    options = (json_option, time_limit, max_denominator_option, set_option)
    for parameter in (*options, native_fmu_argument):
        command = parameter(command)
    return command


def print_search_result(
    result: SearchResult,
    what: str,
    value: float | None,
    unit: str,
    as_json: bool,
    provenance: Provenance,
    settings: Mapping[str, float],
) -> int:
    """Print the result of a search and return the exit code, 1 when there is no value."""
    (fmu,) = provenance.fmus
    faces = int(settings.get("friction_faces", Device().friction_faces))
    text = (
        f"{_sentences(result, what, value, unit)}\n"
        f"friction         on {number_of(faces, 'face')} (friction_faces)\n"
        f"FMU              {one_line(fmu.fmu)}"
    )
    print_result(result, text, as_json=as_json, provenance=provenance)
    return 1 if value is None else 0


def _sentences(outcome: SearchResult, what: str, value: float | None, unit: str) -> str:
    found = "none" if value is None else f"{readable(value, 10)} {unit}"
    lines = [
        f"{what:<17}{found}",
        f"status           {outcome.status}: {one_line(outcome.reason)}",
        f"FMU's output     {readable(outcome.predicted, 10)} {unit} (read without a run)",
    ]
    if outcome.common_period is not None:
        lines.append(
            f"cost             {number_of(outcome.periods, 'drive period')} in "
            f"{number_of(outcome.iterations, 'iteration')}, "
            f"a common period is {outcome.common_period} of them"
        )
    if outcome.multipliers:
        sizes = ", ".join(f"{abs(multiplier):.6f}" for multiplier in outcome.multipliers)
        lines.append(f"multipliers      {sizes} (magnitudes)")
    return "\n".join(lines)
