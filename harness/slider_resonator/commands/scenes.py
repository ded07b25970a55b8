"""`scenes`: what is built in, and what scenes can be made of."""

from __future__ import annotations

import click
from rich import box
from rich.table import Table

from slider_resonator.commands.options import json_option
from slider_resonator.output.console import output
from slider_resonator.output.json_output import to_json
from slider_resonator.scenes.scene import built_in_scenes, read_scene
from slider_resonator.scenes.vocabulary import QUANTITIES


@click.command("scenes")
@click.option("--quantities", is_flag=True, help="List what a scene can expect something of.")
@json_option
def scenes_command(quantities: bool, as_json: bool) -> None:
    """List the built-in scenes, or the quantities and references for scenes of your own.

    The command run takes those that have a length, in simulated seconds; validate takes all.

    \b
    Examples:
      python -m harness scenes
      python -m harness scenes --json
      python -m harness scenes --quantities
    """
    if quantities:
        _list_quantities(as_json)
    else:
        _list_scenes(as_json)


def _list_quantities(as_json: bool) -> None:
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
    if as_json:
        click.echo(to_json(rows))
        return
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column in ("quantity", "kind", "unit", "meaning", "references"):
        table.add_column(column, overflow="fold")
    for name, quantity in QUANTITIES.items():
        references = ", ".join(quantity.references) or "-"
        table.add_row(name, quantity.kind, quantity.unit, quantity.meaning, references)
    output().print(table)


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
        click.echo(to_json(rows))
        return
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column in ("scene", "title", "run", "points", "checks"):
        table.add_column(column)
    for scene in scenes:
        points = len(scene.sweep.values) if scene.sweep else 1
        length = "-" if scene.stop_time is None else f"{scene.stop_time:.3g} s"
        checks = str(points * len(scene.expect))
        table.add_row(scene.name, scene.title, length, str(points), checks)
    output().print(table)
