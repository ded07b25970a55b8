"""`scenes`: list the built-in scenes; template, check and schema of scene files."""

import json
from collections.abc import Sequence
from typing import Any

import click

from slider_resonator.commands import options
from slider_resonator.commands.options import json_option
from slider_resonator.output.console import print_result
from slider_resonator.output.readable import escaped, number_of
from slider_resonator.output.table import Table, numbers, texts
from slider_resonator.scenes.expansion import variants
from slider_resonator.scenes.json_schema import scene_schema
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import find_scene, find_scenes, is_core, template
from slider_resonator.scenes.toml_file import read_toml, toml_text
from slider_resonator.scenes.vocabulary import QUANTITIES


@click.command("scenes")
@click.option("--all", is_flag=True, help="List the thorough scenes, too, not only the core.")
@click.option("--quantities", is_flag=True, help="List the quantities that a scene can check.")
@click.option("--show", metavar="NAME|FILE", help="Print the text of a scene.")
@click.option("--template", is_flag=True, help="Print a commented scene to start from.")
@click.option(
    "--check", metavar="NAME|FILE|DIR", help="Check whether scenes are valid; nothing is run."
)
@click.option("--schema", is_flag=True, help="Print the JSON schema of scenes, for editors.")
@json_option
def scenes_command(as_json: bool, **chosen: Any) -> None:
    """List the built-in scenes, or help to write your own.

    The core scenes are situations that an engineer knows. The thorough ones are for faults that
    hide; --all and --json list them, too, and validate runs both.

    The command run takes scenes with a length, in simulated seconds; validate takes all. --template
    prints a commented scene; every key of a scene file is in docs/scenes.md.

    \b
    Examples:
      slider-resonator scenes
      slider-resonator scenes --all
      slider-resonator scenes --template > my_step.toml
      slider-resonator scenes --check my_step.toml
      slider-resonator scenes --show table_1
      slider-resonator scenes --schema > scene.schema.json
      slider-resonator scenes --quantities --json
    """
    given = [name for name, value in chosen.items() if value]
    if len(given) > 1:
        raise click.UsageError(f"{' and '.join(f'--{name}' for name in given)}: must be only one")
    if as_json and given not in ([], ["all"], ["quantities"]):
        raise click.UsageError(f"--json does not go with --{given[0]}")
    if chosen["show"]:
        click.echo(escaped(_text(find_scene(chosen["show"]))), nl=False)
    elif chosen["template"]:
        click.echo(template(), nl=False)
    elif chosen["check"]:
        for scene in find_scenes([chosen["check"]]):
            options.note(scene.slips, scene.source)
            checks = sum(len(point.scene.expect) for point in scene.points())
            click.echo(escaped(f"{scene.source}: valid, {number_of(checks, 'check')}"))
    elif chosen["schema"]:
        click.echo(json.dumps(scene_schema(), indent=2))
    elif chosen["quantities"]:
        keys = ("kind", "unit", "meaning", "references", "needs_run")
        every = [{"name": n, **{k: getattr(q, k) for k in keys}} for n, q in QUANTITIES.items()]
        print_result(every, quantities_table(), as_json=as_json)
    else:
        _list_scenes(as_json, all_scenes=chosen["all"])


def _text(scene: Scene) -> str:
    """Return the text of a scene's file, or the scene alone where that has several."""
    path = scene.files[0]
    content = variants(read_toml(path), str(path))
    if len(content) > 1:
        return toml_text(content[scene.name])
    return path.read_text(encoding="utf-8-sig")


def quantities_table() -> Table:
    """Return a line for each quantity that scenes can expect."""
    cells = [
        (name, q.kind, q.unit, q.meaning, ", ".join(q.references) or "-")
        for name, q in QUANTITIES.items()
    ]
    return Table(texts("quantity", "kind", "unit", "meaning", "references"), cells)


def _list_scenes(as_json: bool, *, all_scenes: bool) -> None:
    scenes = find_scenes([])
    rows = [
        {
            "name": scene.name,
            "title": scene.title,
            "description": scene.description,
            "file": str(scene.files[0]),
            "core": is_core(scene),
            "checks": len(scene.expect),
            "stop_time": scene.stop_time,
        }
        for scene in scenes
    ]
    listed = [scene for scene in scenes if all_scenes or is_core(scene)]
    more = number_of(len(scenes) - len(listed), "more scene")
    hint = [[f"{more} with --all"]] if len(listed) < len(scenes) else []
    print_result(rows, scenes_table(listed), *hint, as_json=as_json)


def scenes_table(scenes: Sequence[Scene]) -> Table:
    """Return a line for each scene: its title, length, points and checks."""
    cells = []
    for scene in scenes:
        points = len(scene.sweep.values) if scene.sweep else 1
        length = "-" if scene.stop_time is None else f"{scene.stop_time:.3g} s"
        checks = str(points * len(scene.expect))
        cells.append((scene.name, scene.title, length, str(points), checks))
    return Table([*texts("scene", "title"), *numbers("run", "points", "checks")], cells)
