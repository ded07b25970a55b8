"""`scenes`: list the built-in scenes and the vocabulary of scene files."""

from __future__ import annotations

import click

from slider_resonator.commands.options import json_option
from slider_resonator.commands.results import print_json, print_table
from slider_resonator.output.table import Table, numbers, texts
from slider_resonator.scenes.scene import built_in_scenes, read_scene
from slider_resonator.scenes.vocabulary import QUANTITIES


@click.command("scenes")
@click.option("--quantities", is_flag=True, help="List the quantities that a scene can check.")
@json_option
def scenes_command(quantities: bool, as_json: bool) -> None:
    """List the built-in scenes, or the quantities and references for your own scenes.

    The command run takes scenes with a length, in simulated seconds; validate takes all.

    \b
    The tables of a scene file, of which only name and title are needed:
      name, title, description
      [device]    parameters that differ from table 1
      [inputs]    phase, load, frequency_ratio: a number, { steps }, { ramp } or { csv }
      [tuning]    tunable parameters that change in the run, given as inputs are
      [beside]    device and inputs of a second instance
      [run]       stop_time or drive_periods; step_size, steps_per_period or step_sizes;
                  start_time; read_twice: also after values change, before the step
      [[expect]]  quantity; reference, value, at_most or at_least; relative, absolute, tube; why
      [sweep]     variable, values
      [need]      accuracy that the command choose meets

    \b
    Examples:
      slider-resonator scenes
      slider-resonator scenes --json
      slider-resonator scenes --quantities
    """
    if quantities:
        _list_quantities(as_json)
    else:
        _list_scenes(as_json)


def _list_quantities(as_json: bool) -> None:
    if as_json:
        rows = [
            {
                "name": name,
                "kind": quantity.kind,
                "unit": quantity.unit,
                "meaning": quantity.meaning,
                "references": list(quantity.references),
                "needs_run": quantity.needs_run,
            }
            for name, quantity in QUANTITIES.items()
        ]
        print_json(rows)
        return
    cells = [
        (name, q.kind, q.unit, q.meaning, ", ".join(q.references) or "-")
        for name, q in QUANTITIES.items()
    ]
    print_table(Table(texts("quantity", "kind", "unit", "meaning", "references"), cells))


def _list_scenes(as_json: bool) -> None:
    scenes = [read_scene(path) for path in built_in_scenes().values()]
    if as_json:
        rows = [
            {
                "name": scene.name,
                "title": scene.title,
                "description": scene.description,
                "file": scene.source,
                "checks": len(scene.expect),
                "stop_time": scene.stop_time,
            }
            for scene in scenes
        ]
        print_json(rows)
        return
    cells = []
    for scene in scenes:
        points = len(scene.sweep.values) if scene.sweep else 1
        length = "-" if scene.stop_time is None else f"{scene.stop_time:.3g} s"
        checks = str(points * len(scene.expect))
        cells.append((scene.name, scene.title, length, str(points), checks))
    print_table(Table([*texts("scene", "title"), *numbers("run", "points", "checks")], cells))
