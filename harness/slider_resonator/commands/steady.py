"""`steady`: the steady velocity by shooting."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click

from slider_resonator.commands.options import SettingsCommand
from slider_resonator.commands.searching import print_search_result, search_arguments
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.progress_bar import progress_bar
from slider_resonator.steady.steady_velocity import find_steady


@click.command(
    "steady",
    cls=SettingsCommand,
)
@search_arguments
@click.pass_context
def steady_command(
    context: click.Context,
    fmu: Path,
    settings: dict[str, float],
    max_denominator: int,
    time_limit: float,
    as_json: bool,
) -> None:
    """Find the steady velocity of an FMU by shooting, without a long run.

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
    provenance = provenance_of(fmu)
    search = partial(find_steady, values=settings, max_denominator=max_denominator)
    with progress_bar() as progress, IsolatedFmu(fmu, time_limit) as isolated:
        progress("searching the steady velocity", 0.0)
        motion = isolated.run(search, progress)
    context.exit(print_search_result(motion, as_json, provenance, settings))
