"""`picture`: the picture of the README."""

from __future__ import annotations

from pathlib import Path

import click

from slider_resonator.commands.options import Target, default_fmu
from slider_resonator.output.console import progress_bar
from slider_resonator.output.targets import PICTURE_SUFFIXES, distinct
from slider_resonator.studies.picture import draw_picture


@click.command("picture")
@click.argument("fmu", type=click.Path(path_type=Path), required=False)
@click.option(
    "--out",
    type=Target(PICTURE_SUFFIXES),
    required=True,
    help="PNG, SVG or PDF to write.",
)
def picture_command(fmu: Path | None, out: Path) -> None:
    """Draw the picture of the README from the FMU.

    \b
    Examples:
      python -m harness picture --out picture.png
      python -m harness picture my.fmu --out picture.svg
    """
    fmu = default_fmu(fmu)
    distinct({"--out": out}, {"the FMU": fmu})
    with progress_bar() as progress:
        progress("picture", 0.0)
        draw_picture(fmu, out)
    click.echo(f"written  {out}")
