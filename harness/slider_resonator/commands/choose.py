"""`choose`: the cheapest model that a scene's needs allow, proved by a short probe."""

from __future__ import annotations

from math import isfinite
from pathlib import Path

import click
from rich import box
from rich.console import Console
from rich.table import Table

from slider_resonator.commands.options import (
    SettingsCommand,
    check_left_to_choose,
    default_fmu,
    json_option,
    set_option,
)
from slider_resonator.output.console import output
from slider_resonator.output.json_output import to_json
from slider_resonator.scenes.scene import find_scene, read_scene
from slider_resonator.studies.choose import Choice, choose
from slider_resonator.studies.choose.candidate import Model

UNITS = {
    "mean_velocity": "m/s",
    "position": "m",
    "velocity": "m/s",
    "steady_velocity": "m/s",
    "blocking_force": "N",
    "event_times": "s",
    "beat": "Hz",
}


@click.command("choose", cls=SettingsCommand)
@click.argument("scene")
@click.option(
    "--fmu",
    type=click.Path(path_type=Path),
    help="FMU to try it in; by default the native one in dist.",
)
@set_option
@json_option
@click.pass_context
def choose_command(
    context: click.Context,
    scene: str,
    fmu: Path | None,
    settings: dict[str, float],
    as_json: bool,
) -> None:
    """Choose fidelity, friction law, tolerance and communication step for what a scene needs.

    The scene, built in or from a file, says it in [need]: any of mean_velocity, position, velocity,
    steady_velocity, blocking_force, event_times and beat, each with abs or rel, and friction_law =
    "free" where either law will do. Laws of the errors say where to look, and a short resolved run
    in the FMU confirms the answer. Fidelity and tolerance of the scene itself do not matter, its
    step is where signals are compared; of a scene with a sweep the unvaried device is taken.
    Leaves with 0 when something suffices, with 1 when nothing does (then the nearest is shown), and
    with 2 when the scene could not be run.

    \b
    Examples:
      python -m harness choose feed_forward
      python -m harness choose scenes/mine.toml --json
      python -m harness choose feed_forward --set friction_law=1 bristle_stiffness=1e6
    """
    check_left_to_choose(settings)
    read = read_scene(find_scene(scene), settings)
    choice = choose(read, default_fmu(fmu))
    if as_json:
        click.echo(to_json(choice))
    else:
        _show(choice, output())
    context.exit(0 if choice.meets else 1)


def _show(choice: Choice, console: Console) -> None:
    for line in choice.sentences():
        console.print(line, soft_wrap=True)
    needs = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column in ("need", "predicted error", "allowed", "unit"):
        needs.add_column(column)
    for name, error in choice.error.items():
        shown = f"{error:.3g}" if isfinite(error) else "no bound"
        needs.add_row(name, shown, f"{choice.allowed[name]:.3g}", UNITS[name])
    console.print(needs)
    if choice.ruled_out:
        others = Table(box=box.SIMPLE_HEAD, pad_edge=False)
        for column in ("ruled out", "why"):
            others.add_column(column)
        for model in choice.ruled_out:
            others.add_row(Model(model.fidelity, model.friction_law).name, model.why)
        console.print(others)
