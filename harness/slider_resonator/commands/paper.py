"""`paper`: every figure and statement of the paper beside what the FMU gives, and tables."""

from __future__ import annotations

from pathlib import Path

import click

from slider_resonator.commands.options import default_fmu, json_option
from slider_resonator.output.console import progress_bar
from slider_resonator.output.json_output import to_json
from slider_resonator.studies.paper.listing import verdicts
from slider_resonator.studies.paper.reproduce import NAMES, Outcome, reproduce


@click.command("paper")
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    required=True,
    help="Folder to write to.",
)
@click.option(
    "--only",
    type=click.Choice(NAMES),
    multiple=True,
    help="Make only this; may be given several times.",
)
@click.option("--fmu", type=click.Path(path_type=Path), help="FMU to run instead of the built one.")
@json_option
@click.pass_context
def paper_command(
    context: click.Context, out: Path, only: tuple[str, ...], fmu: Path | None, as_json: bool
) -> None:
    """Reproduce the paper: its figures, three more, and a verdict on each of its statements.

    Writes figures as PNG and SVG with captions in FIGURES.md, tables of LuGre friction as JSON and
    in TABLES.md, and claims.md and claims.json. Leaves with 0, with 1 when a statement is not found
    as it is known to be or a table deviates, 2 when the FMU could not be run.

    \b
    Examples:
      python -m harness paper --out paper
      python -m harness paper --out paper --only figure_8 --only claims --json
    """
    with progress_bar() as progress:
        outcome = reproduce(default_fmu(fmu), out, only, progress)
    click.echo(to_json(outcome) if as_json else _sentences(outcome))
    context.exit(0 if outcome.confirmed else 1)


def _sentences(outcome: Outcome) -> str:
    lines = [f"written  {outcome.out} in {outcome.wall_time:.1f} s"]
    lines.append(f"run      {', '.join(outcome.run)}")
    for table in outcome.tables:
        for name, size in table.largest.items():
            verdict = "table   " if size <= table.allowed[name] else "FAIL    "
            allowed = f"allowed {table.allowed[name]:g}"
            lines.append(f"{verdict} {table.name}: {name} up to {size:.2g}, {allowed}")
    if outcome.claims:
        lines.append(f"claims   {verdicts(outcome.claims)}")
    for claim in outcome.claims:
        if not claim["confirmed"]:
            numbers = ", ".join(f"{name} = {value}" for name, value in claim["numbers"].items())
            lines.append(
                f"FAIL     {claim['name']}: {claim['statement']}: expected: {claim['verdict']}, "
                f"{claim['why']}; measured: {numbers}"
            )
    return "\n".join(lines)
