"""`blocking`: the blocking force by shooting."""

from __future__ import annotations

from pathlib import Path

import click

from harness.blocking import Blocking, find_blocking
from harness.commands.options import (
    fmu_argument,
    json_option,
    max_denominator_option,
    set_option,
)
from harness.drive import instantiate
from harness.fmu import open_fmu
from harness.json_output import to_json
from harness.readable import readable


@click.command("blocking")
@fmu_argument
@set_option
@max_denominator_option
@json_option
@click.pass_context
def blocking_command(
    context: click.Context,
    fmu: Path,
    settings: dict[str, float],
    max_denominator: int,
    as_json: bool,
) -> None:
    """Find the load that stops an FMU, by shooting, without a long run.

    The load is one more unknown of the shooting, no displacement over the common period one more
    equation. Leaves with 0 when it is found, 1 when there is none (the status says why), 2 when
    the FMU could not be run. --set load=... is where the search begins.

    \b
    Examples:
      python -m harness blocking my.fmu
      python -m harness blocking my.fmu --set phase=0.4 --set friction_faces=1 --json
    """
    with open_fmu(fmu) as opened, instantiate(opened) as instance:
        blocking = find_blocking(instance, settings, max_denominator=max_denominator)
    click.echo(to_json(blocking) if as_json else _sentences(blocking))
    context.exit(0 if blocking.blocking_force is not None else 1)


def _sentences(blocking: Blocking) -> str:
    force = blocking.blocking_force
    lines = [
        f"blocking force   {'none' if force is None else f'{readable(force, 10)} N'}",
        f"status           {blocking.status}: {blocking.reason}",
        f"averaged theory  {readable(blocking.predicted, 10)} N (the FMU's own output)",
    ]
    if blocking.common_period is not None:
        lines.append(
            f"cost             {blocking.periods} drive periods in {blocking.iterations} "
            f"iterations, a common period is {blocking.common_period} of them"
        )
    return "\n".join(lines)
