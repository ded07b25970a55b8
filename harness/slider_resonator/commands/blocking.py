"""`blocking`: the blocking force by shooting."""

from __future__ import annotations

from pathlib import Path

import click

from slider_resonator.commands.options import SettingsCommand
from slider_resonator.commands.searching import print_outcome, search_arguments
from slider_resonator.fmu.drive import instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.steady.blocking_force import find_blocking


@click.command("blocking", cls=SettingsCommand)
@search_arguments
@click.pass_context
def blocking_command(
    context: click.Context,
    fmu: Path,
    settings: dict[str, float],
    max_denominator: int,
    as_json: bool,
) -> None:
    """Find the load that stops an FMU, by shooting, without a long run.

    The load is one more unknown of the shooting, zero displacement over the common period one more
    equation. --set load=... is the initial guess. Exit code: 0 when it is found, 1 when there is
    none (the status says why), 2 when the FMU could not run.

    \b
    Examples:
      python -m harness blocking my.fmu
      python -m harness blocking my.fmu --set phase=0.4 friction_faces=1 --json
      python -m harness blocking my.fmu --set friction_law=1 bristle_stiffness=1e4
    """
    with open_fmu(fmu) as opened, instantiate(opened) as instance:
        blocking = find_blocking(instance, settings, max_denominator=max_denominator)
    context.exit(print_outcome(blocking, "blocking force", blocking.blocking_force, "N", as_json))
