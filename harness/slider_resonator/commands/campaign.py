"""`campaign`: random devices and schedules against the references."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import click

from slider_resonator.commands.options import (
    Target,
    default_fmus,
    fmus_argument,
    json_option,
    time_limit_option,
)
from slider_resonator.commands.results import print_result
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.atomic import write_text
from slider_resonator.output.console import noting_on_interrupt
from slider_resonator.output.json_output import to_json
from slider_resonator.output.progress import part_of
from slider_resonator.output.progress_bar import progress_bar
from slider_resonator.output.readable import number_of
from slider_resonator.output.targets import distinct
from slider_resonator.output.terminal import one_line
from slider_resonator.stress.campaign.campaign_run import TIME_LIMIT, Campaign, run_campaign
from slider_resonator.stress.campaign.listing import as_plain, sentences
from slider_resonator.stress.campaign.random_case import random_case


@click.command("campaign")
@fmus_argument
@click.option(
    "--cases",
    type=click.IntRange(min=1),
    default=1000,
    show_default=True,
    help="Number of cases. Each takes about half a second.",
)
@click.option(
    "--first",
    type=click.IntRange(min=0),
    default=0,
    show_default=True,
    envvar="CAMPAIGN_FIRST",
    show_envvar=True,
    help="Number of the first case.",
)
@click.option(
    "--seed",
    type=click.IntRange(min=0),
    default=1,
    show_default=True,
    envvar="CAMPAIGN_SEED",
    show_envvar=True,
    help="Seed of the campaign: the same cases everywhere.",
)
@click.option(
    "--case",
    "number",
    type=click.IntRange(min=0),
    help="Run only the case of this number, and print its values.",
)
@time_limit_option(TIME_LIMIT, "For each case; one that hangs fails.")
@click.option("--out", type=Target((".json",)), help="Write the result as JSON, too.")
@click.option("--html", type=Target((".html",)), help="One page with plots to point at.")
@json_option
@click.pass_context
def campaign_command(
    context: click.Context,
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
    """Run FMUs with random devices and schedules, and compare them with the references.

    Devices lie over decades; inputs, tunable parameters and step sizes change in the run; both
    friction laws and fidelities 0 (averages of both orders), 1 and 2 come in turn. Each case is
    judged by the errors that its numerics state, and averages of second order, against resolved
    motion, by what they may lag behind it and slow_motion_error, too. Without FMUS: those in dist.
    Exit code: 0 when no case fails, 1 when one does, 2 when an FMU could not run. What is finished
    when the command is interrupted is written to --out and --html.

    \b
    Examples:
      slider-resonator campaign --cases 10000 --out campaign.json --html campaign.html
      slider-resonator campaign my.fmu --seed 1 --case 44
    """
    chosen = fmus or default_fmus()
    distinct({"--out": out, "--html": html}, {f"the FMU {path}": path for path in chosen})
    for path in chosen:
        with open_fmu(path):  # before any campaign runs: one takes minutes
            pass
    numbers = range(first, first + cases) if number is None else (number,)
    random_cases = [random_case(seed, one) for one in numbers]
    provenance = provenance_of(*chosen)
    finished: list[Campaign] = []
    files = [path for path in (out, html) if path is not None]

    def keep(campaign: Campaign) -> None:
        finished.append(campaign)
        if out is not None:
            write_text(out, to_json(as_plain(finished), provenance))
        if html is not None:
            # Imported here: it takes longer to load than a case to run.
            from slider_resonator.stress.campaign.page import write_campaigns

            write_campaigns(html, finished, provenance)

    with noting_on_interrupt(partial(_kept, finished, files)), progress_bar() as progress:
        for index, fmu in enumerate(chosen):
            part = part_of(progress, index, len(chosen))
            keep(run_campaign(fmu, random_cases, part, time_limit, keep))
    lines = [
        sentences(campaign, random_cases if number is not None else ()) for campaign in finished
    ]
    lines += [f"written {one_line(str(path))}" for path in files]
    text = "\n".join(lines)
    print_result(as_plain(finished), text, as_json=as_json, provenance=provenance)
    context.exit(0 if all(campaign.passed for campaign in finished) else 1)


def _kept(finished: Sequence[Campaign], files: Sequence[Path]) -> str:
    if not finished or not files:
        return "nothing is kept; --out FILE keeps what is finished"
    ran = sum(len(campaign.verdicts) for campaign in finished)
    places = " and ".join(map(str, files))
    return (
        f"the verdicts of {number_of(ran, 'case')} are kept in {places}; the same command runs "
        "all cases again"
    )
