"""`campaign`: the random devices of `stress`, under the name that they once had."""

from __future__ import annotations

from pathlib import Path

import click

from slider_resonator.commands.options import fmus_argument, json_option, target, time_limit_option
from slider_resonator.commands.stress import CASES, seed_options, stress
from slider_resonator.stressing.listing import Files
from slider_resonator.stressing.random_cases import random_case


@click.command("campaign")
@fmus_argument
@click.option(
    "--cases",
    type=click.IntRange(min=1),
    default=CASES,
    show_default=True,
    help="Number of cases. Each takes about half a second.",
)
@seed_options
@click.option(
    "--case",
    "number",
    type=click.IntRange(min=0),
    help="Run only the case of this number, and print its values.",
)
@time_limit_option(60.0, "For each case; one that hangs fails.")
@click.option("--out", type=target((".json",)), help="Write the result as JSON, too.")
@click.option("--html", type=target((".html",)), help="One page with plots to point at.")
@json_option
def campaign_command(
    fmus: tuple[Path, ...],
    cases: int,
    first: int,
    seed: int,
    number: int | None,
    time_limit: float,
    out: Path | None,
    html: Path | None,
    as_json: bool,
) -> None:
    """Run `stress` with random devices.

    \b
    Examples:
      slider-resonator campaign --cases 10000 --out campaign.json --html campaign.html
      slider-resonator campaign my.fmu --seed 1 --case 44
    """
    numbers = range(first, first + cases) if number is None else (number,)
    drawn = [random_case(seed, one) for one in numbers]
    stress(fmus, drawn, Files(out, html), time_limit, as_json=as_json)
