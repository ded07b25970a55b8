"""`paper`: reproduce every figure and statement of the paper with the FMU, and more tables."""

from pathlib import Path

import click

from slider_resonator.commands.options import (
    fmu_option,
    json_option,
    out_folder_option,
    time_limit_option,
)
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import print_result
from slider_resonator.output.progress import progress_bar
from slider_resonator.output.readable import one_line
from studies.paper.listing import verdicts
from studies.paper.reproduce import NAMES, TIME_LIMIT, Outcome, reproduce


@click.command("paper")
@out_folder_option("figures, tables and claims")
@click.option(
    "--only",
    type=click.Choice(NAMES),
    metavar="NAME",
    multiple=True,
    help=f"Make only this. Repeatable. One of {', '.join(NAMES)}.",
)
@fmu_option
@time_limit_option(TIME_LIMIT, "For each figure, table and group of claims.")
@json_option
@click.pass_context
def paper_command(
    context: click.Context,
    out: Path,
    only: tuple[str, ...],
    fmu: Path,
    time_limit: float,
    as_json: bool,
) -> None:
    """Reproduce the paper: its figures, three more, and a verdict on each of its statements.

    Write index.html with all of them, figures as PNG and SVG with captions in FIGURES.md, tables of
    LuGre friction as JSON and in TABLES.md, and claims.md and claims.json. Exit code: 0, 1 when a
    known verdict on a statement is not confirmed or a table deviates, 2 when the FMU could not run,
    crashed or exceeded the time limit; what is finished by then is kept.

    \b
    Examples:
      python -m harness paper --out paper
      python -m harness paper --out paper --only figure_8 --only claims --json
    """
    provenance = provenance_of(fmu)
    with progress_bar() as progress:
        outcome = reproduce(fmu, out, only, progress, time_limit)
    print_result(outcome, _sentences(outcome), as_json=as_json, provenance=provenance)
    context.exit(0 if outcome.confirmed else 1)


def _sentences(outcome: Outcome) -> list[str]:
    lines = [f"written  {one_line(outcome.out)} in {outcome.wall_time:.1f} s"]
    lines.append(f"run      {', '.join(outcome.run)}")
    for table in outcome.tables:
        for name, size in table.largest.items():
            verdict = "table   " if size <= table.allowed[name] else "FAIL    "
            allowed = f"allowed {table.allowed[name]:g}"
            lines.append(f"{verdict} {table.name}: {name} up to {size:.2g}, {allowed}")
    if outcome.claims:
        lines.append(f"claims   {verdicts(outcome.claims)}")
    for claim in outcome.claims:
        if not claim.confirmed:
            numbers = ", ".join(f"{name} = {value}" for name, value in claim.numbers.items())
            lines.append(
                f"FAIL     {claim.name}: {claim.statement}: expected: {claim.verdict}, "
                f"{claim.why}; measured: {numbers}"
            )
    return lines
