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
from slider_resonator.output.readable import number_of
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
    result: SearchResult, as_json: bool, provenance: Provenance, settings: Mapping[str, float]
) -> int:
    """Print the result of a search and return the exit code, 1 when there is no value."""
    (fmu,) = provenance.fmus
    faces = int(settings.get("friction_faces", Device().friction_faces))
    lines = [
        *result.describe(),
        f"friction         on {number_of(faces, 'face')} (friction_faces)",
        f"FMU              {one_line(fmu.fmu)}",
    ]
    print_result(result, "\n".join(lines), as_json=as_json, provenance=provenance)
    return 1 if result.answer[1] is None else 0
