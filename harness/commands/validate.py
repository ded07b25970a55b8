"""`validate`: scenes, references, verdicts."""

from __future__ import annotations

from pathlib import Path

import click

from harness.commands.options import default_fmus, json_option
from harness.console import output, progress_bar
from harness.json_output import to_json
from harness.report import print_validation
from harness.scene import built_in_scenes, find_scene
from harness.validate import Validation, validate


@click.command("validate")
@click.argument("fmus", type=click.Path(path_type=Path), nargs=-1)
@click.option(
    "--scene",
    "scenes",
    multiple=True,
    metavar="NAME|FILE",
    help="A built-in scene or a scene file; may be given several times.  [default: all built-in]",
)
@click.option("--details", is_flag=True, help="Show every point of a sweep, and the reasons.")
@json_option
@click.pass_context
def validate_command(
    context: click.Context,
    fmus: tuple[Path, ...],
    scenes: tuple[str, ...],
    details: bool,
    as_json: bool,
) -> None:
    """Compare FMUs with the references, scene by scene.

    Without FMUS: those that build_fmu.py has built in dist, the native one first. Leaves with 0
    when every check passes, 1 when one fails, 2 when something could not be run.

    \b
    Examples:
      python -m harness validate
      python -m harness validate my.fmu --scene table_1 --details
      python -m harness validate my.fmu --scene scenes/mine.toml --json > report.json
    """
    files = [find_scene(scene) for scene in scenes or built_in_scenes()]
    with progress_bar() as progress:
        validations = validate(fmus or default_fmus(), files, progress)
    passed = all(validation.passed for validation in validations)
    if as_json:
        plain = [_plain(validation) for validation in validations]
        click.echo(to_json(plain[0] if len(plain) == 1 else {"passed": passed, "fmus": plain}))
    else:
        for validation in validations:
            print_validation(output(), validation, details=details)
    context.exit(0 if passed else 1)


def _plain(validation: Validation) -> dict[str, object]:
    return {
        "fmu": validation.fmu,
        "passed": validation.passed,
        "wall_time": validation.wall_time,
        "checks": validation.checks,
    }
