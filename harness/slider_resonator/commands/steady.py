"""`steady` and `blocking`: the steady velocity and the blocking force by shooting."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import click

from slider_resonator.commands import options
from slider_resonator.device.drive_periods import MAX_DENOMINATOR
from slider_resonator.fmu.isolation.process import TIME_LIMIT, IsolatedFmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import print_result
from slider_resonator.output.progress import progress_bar
from slider_resonator.output.readable import one_line
from slider_resonator.steady.searches import SearchResult, find_blocking, find_steady, refuse_load

STEADY = """\
Find the steady velocity of an FMU by shooting, without a long run.

The steady motion is a fixed point of the map over one common period.
--set initial_velocity=... is the initial guess. With LuGre friction the bristle is part of the
state, and the FMU's tolerance, 1e-8 unless set, bounds the accuracy. Exit code: 0 when there is
a steady motion, 1 when there is none (the status says why), 2 when the FMU could not run,
crashed or exceeded the time limit.

\b
Examples:
  slider-resonator steady
  slider-resonator steady my.fmu --set phase=0.4 load=0.05 --json
  slider-resonator steady my.fmu --set friction_law=1 bristle_stiffness=1e6 tolerance=1e-12
  slider-resonator steady my.fmu --set frequency_ratio=1.37 --max-denominator 100
"""
BLOCKING = """\
Find the load that stops an FMU, by shooting, without a long run.

The load is one more unknown of the shooting, zero displacement over the common period one more
equation. Exit code: 0 when it is found, 1 when there is none (the status says why), 2 when the
FMU could not run, crashed or exceeded the time limit.

\b
Examples:
  slider-resonator blocking
  slider-resonator blocking my.fmu --set phase=0.4 friction_faces=1 --json
  slider-resonator blocking my.fmu --set friction_law=1 bristle_stiffness=1e4
"""


def _search_command(
    name: str, what: str, find: Callable[..., SearchResult], help_text: str
) -> click.Command:
    """Return the command that searches something of an FMU by shooting."""

    @click.command(name, cls=options.SettingsCommand, help=help_text)
    @options.fmu_argument
    @options.device_options
    @click.option(
        "--max-denominator",
        type=click.IntRange(min=1),
        default=MAX_DENOMINATOR,
        help="Largest q for which a frequency ratio p/q counts as having a common period.",
    )
    @options.time_limit_option(TIME_LIMIT, "For the whole search.")
    @options.json_option
    def command(
        fmu: Path, given: options.Given, max_denominator: int, time_limit: float, as_json: bool
    ) -> int:
        if find is find_blocking:
            refuse_load(given.values)
        provenance = provenance_of(fmu)
        search = partial(find, values=given.values, max_denominator=max_denominator)
        with progress_bar() as progress, IsolatedFmu(fmu, time_limit) as isolated:
            progress(f"searching the {what}", 0.0)
            result: SearchResult = isolated.run(search)
        lines = [*result.describe(), f"FMU              {one_line(str(fmu))}"]
        print_result(result, lines, as_json=as_json, provenance=provenance)
        return 1 if result.value is None else 0

    return command


steady_command = _search_command("steady", "steady velocity", find_steady, STEADY)
blocking_command = _search_command("blocking", "blocking force", find_blocking, BLOCKING)
