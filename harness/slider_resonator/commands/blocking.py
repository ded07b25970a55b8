"""`blocking`: the blocking force by shooting."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click

from slider_resonator.commands.options import SettingsCommand
from slider_resonator.commands.searching import print_search_result, search_arguments
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.progress_bar import progress_bar
from slider_resonator.steady.blocking_force import find_blocking


@click.command(
    "blocking",
    cls=SettingsCommand,
)
@search_arguments
@click.pass_context
def blocking_command(
    context: click.Context,
    fmu: Path,
    settings: dict[str, float],
    max_denominator: int,
    time_limit: float,
    as_json: bool,
) -> None:
    """Find the load that stops an FMU, by shooting, without a long run.

    The load is one more unknown of the shooting, zero displacement over the common period one more
    equation. --set load=... is the initial guess. Exit code: 0 when it is found, 1 when there is
    none (the status says why), 2 when the FMU could not run, crashed or exceeded the time limit.

    \b
    Examples:
      slider-resonator blocking
      slider-resonator blocking my.fmu --set phase=0.4 friction_faces=1 --json
      slider-resonator blocking my.fmu --set friction_law=1 bristle_stiffness=1e4
    """
    provenance = provenance_of(fmu)
    search = partial(find_blocking, values=settings, max_denominator=max_denominator)
    with progress_bar() as progress, IsolatedFmu(fmu, time_limit) as isolated:
        progress("searching the blocking force", 0.0)
        blocking = isolated.run(search, progress)
    context.exit(print_search_result(blocking, as_json, provenance, settings))
