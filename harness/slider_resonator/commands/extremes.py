"""`extremes`: the axes of `stress`, under the name that they once had."""

from __future__ import annotations

from pathlib import Path

import click

from slider_resonator.commands.options import (
    fmus_argument,
    json_option,
    out_folder_option,
    time_limit_option,
)
from slider_resonator.commands.stress import case_named, long_option, stress
from slider_resonator.stressing.axes import axis_cases
from slider_resonator.stressing.listing import in_folder
from slider_resonator.stressing.run import TIME_LIMIT


@click.command("extremes")
@fmus_argument
@out_folder_option("extremes.json and index.html")
@time_limit_option(TIME_LIMIT, "For each case; one that hangs fails.", "--limit")
@long_option
@click.option("--cell", "name", metavar="NAME", help="Run only the case of this name.")
@json_option
def extremes_command(
    fmus: tuple[Path, ...],
    out: Path,
    time_limit: float,
    long: bool,
    name: str | None,
    as_json: bool,
) -> None:
    """Run `stress` on its axes.

    \b
    Examples:
      slider-resonator extremes --out extremes
      slider-resonator extremes my.fmu --out one --cell "r_m: 1e-12: Coulomb, fidelity 1"
    """
    cases = axis_cases(long=long) if name is None else [case_named(name, "--cell")]
    stress(fmus, cases, in_folder(out, "extremes"), time_limit, as_json=as_json)
