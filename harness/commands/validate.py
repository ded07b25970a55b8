"""`validate`: scenes, references, verdicts, and reports for people and CI servers."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import click

from harness.commands.options import Target, default_fmus
from harness.console import output, progress_bar
from harness.errors import HarnessError
from harness.isolated_runs import TIME_LIMIT
from harness.json_report import validations_as_json, write_json
from harness.junit import write_junit
from harness.report import print_validation
from harness.scene import built_in_scenes, scene_files
from harness.step_summary import VARIABLE, append_summary
from harness.targets import distinct
from harness.validate import Validation, validate

PRINTED = Path("-")
"""What `--json` without a file stands for."""


class JsonTarget(Target):
    """A JSON file to write, or standard output."""

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> Path:
        """Return the path, `PRINTED` as it is."""
        return PRINTED if str(value) == str(PRINTED) else super().convert(value, param, ctx)


@dataclass(frozen=True)
class Reports:
    """Where verdicts go, beside the terminal; None where a report was not asked for."""

    junit: Path | None
    html: Path | None
    json: Path | None
    summary: Path | None

    def write(self, validations: Sequence[Validation], error: str = "") -> None:
        """Write all that were asked for; HarnessError where one cannot be written."""
        if self.json is not None and self.json != PRINTED:
            write_json(self.json, validations, error)
        if self.junit is not None:
            write_junit(self.junit, validations, error)
        if self.summary is not None:
            append_summary(self.summary, validations, error)
        if self.html is not None:
            # Here, for drawing takes longer to load than everything else.
            from harness.html_report import write_html

            write_html(self.html, validations, error)


@click.command("validate")
@click.argument("fmus", type=click.Path(path_type=Path), nargs=-1)
@click.option(
    "--scene",
    "scenes",
    multiple=True,
    metavar="NAME|FILE|DIR",
    help="A built-in scene, a scene file or a folder of scene files; may be given several times.  "
    "[default: all built-in]",
)
@click.option("--details", is_flag=True, help="Show every point of a sweep, and the reasons.")
@click.option(
    "--time-limit",
    type=click.FloatRange(min=0.0, min_open=True),
    default=TIME_LIMIT,
    show_default=True,
    metavar="SECONDS",
    help="For each scene, or point of a sweep, on each FMU.",
)
@click.option("--junit", type=Target([".xml"]), help="JUnit XML for a CI server.")
@click.option("--html", type=Target([".html"]), help="One page with pictures of what differs.")
@click.option(
    "--json",
    type=JsonTarget([".json"]),
    is_flag=False,
    flag_value=str(PRINTED),
    metavar="[FILE.json]",
    help="Write one JSON document, or print it when no file is given.",
)
@click.pass_context
def validate_command(
    context: click.Context,
    fmus: tuple[Path, ...],
    scenes: tuple[str, ...],
    details: bool,
    time_limit: float,
    junit: Path | None,
    html: Path | None,
    json: Path | None,
) -> None:
    """Compare FMUs with the references, scene by scene.

    Without FMUS: those that build_fmu.py has built in dist, the native one first. Leaves with 0
    when every check passes, 1 when one fails, 2 when something could not be run: an FMU that is
    corrupt, lacks a variable or gives one another unit, has no binary for this platform, cannot be
    instantiated, refuses a scene, crashes or does not answer in time. The reports are written in
    each case, and a table is appended to the file that GITHUB_STEP_SUMMARY names.

    \b
    Examples:
      python -m harness validate
      python -m harness validate my.fmu --scene table_1 --details
      python -m harness validate my.fmu --scene scenes/mine.toml --json > report.json
      python -m harness validate my.fmu --scene my_scenes --junit report.xml --html report.html
    """
    sources = {f"the FMU {path}": path for path in fmus}
    sources |= {f"the scene {scene}": Path(scene) for scene in scenes}
    written = None if json == PRINTED else json
    distinct({"--junit": junit, "--html": html, "--json": written}, sources)
    summary = os.environ.get(VARIABLE)
    reports = Reports(junit, html, json, Path(summary) if summary else None)
    try:
        files = [file for scene in scenes or built_in_scenes() for file in scene_files(scene)]
        paths = fmus or default_fmus()
        with progress_bar() as progress:
            validations = validate(paths, files, progress, time_limit=time_limit)
    except HarnessError as error:
        reports.write([], str(error))
        raise
    _print(validations, details, as_json=json == PRINTED)
    reports.write(validations)
    context.exit(max(validation.exit_code for validation in validations))


def _print(validations: Sequence[Validation], details: bool, *, as_json: bool) -> None:
    if as_json:
        click.echo(validations_as_json(validations))
    for validation in validations:
        if validation.checks and not as_json:
            print_validation(output(), validation, details=details)
        for trouble in validation.troubles:
            scene = f"{validation.fmu}: scene {trouble.scene}: " * bool(trouble.scene)
            click.echo(f"error: {scene}{trouble.reason}", err=True)
