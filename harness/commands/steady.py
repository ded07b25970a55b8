"""`steady`: the steady velocity by shooting."""

from __future__ import annotations

from pathlib import Path

import click

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
from harness.steady import SteadyMotion, find_steady


@click.command("steady")
@fmu_argument
@set_option
@max_denominator_option
@json_option
@click.pass_context
def steady_command(
    context: click.Context,
    fmu: Path,
    settings: dict[str, float],
    max_denominator: int,
    as_json: bool,
) -> None:
    """Find the steady velocity of an FMU by shooting, without a long run.

    The steady motion is a fixed point of the map over one common period. Leaves with 0 when there
    is one, 1 when there is none (the status says why), 2 when the FMU could not be run.
    --set initial_velocity=... is where the search begins.

    \b
    Examples:
      python -m harness steady my.fmu
      python -m harness steady my.fmu --set phase=0.4 --set load=0.05 --json
      python -m harness steady my.fmu --set frequency_ratio=1.37 --max-denominator 100
    """
    with open_fmu(fmu) as opened, instantiate(opened) as instance:
        motion = find_steady(instance, settings, max_denominator=max_denominator)
    click.echo(to_json(motion) if as_json else _sentences(motion))
    context.exit(0 if motion.steady_velocity is not None else 1)


def _sentences(motion: SteadyMotion) -> str:
    velocity = motion.steady_velocity
    lines = [
        f"steady velocity  {'none' if velocity is None else f'{readable(velocity, 10)} m/s'}",
        f"status           {motion.status}: {motion.reason}",
        f"averaged theory  {readable(motion.predicted, 10)} m/s (the FMU's own output)",
    ]
    if motion.common_period is not None:
        lines.append(
            f"cost             {motion.periods} drive periods in {motion.iterations} iterations, "
            f"a common period is {motion.common_period} of them"
        )
    if motion.multipliers:
        sizes = ", ".join(f"{abs(multiplier):.6f}" for multiplier in motion.multipliers)
        lines.append(f"multipliers      {sizes} (magnitudes)")
    return "\n".join(lines)
