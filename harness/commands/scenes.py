"""`scenes`: what is built in."""

from __future__ import annotations

import click
from rich import box
from rich.table import Table

from harness.commands.options import json_option
from harness.console import output
from harness.json_output import to_json
from harness.scene import built_in_scenes, read_scene


@click.command("scenes")
@json_option
def scenes_command(as_json: bool) -> None:
    """List the built-in scenes.

    \b
    Examples:
      python -m harness scenes
      python -m harness scenes --json
    """
    scenes = [read_scene(path) for path in built_in_scenes().values()]
    if as_json:
        rows = [
            {
                "name": scene.name,
                "title": scene.title,
                "description": scene.description,
                "file": scene.source,
                "checks": len(scene.expect),
            }
            for scene in scenes
        ]
        click.echo(to_json(rows))
        return
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column in ("scene", "title", "points", "checks"):
        table.add_column(column)
    for scene in scenes:
        points = len(scene.sweep.values) if scene.sweep else 1
        table.add_row(scene.name, scene.title, str(points), str(points * len(scene.expect)))
    output().print(table)
