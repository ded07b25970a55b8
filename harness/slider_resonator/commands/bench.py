"""`bench`: the cost of a communication step in a C host."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click
from rich import box
from rich.table import Table

from slider_resonator.commands.options import default_fmu, json_option
from slider_resonator.errors import FmuError
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.output.console import output, progress_bar
from slider_resonator.output.json_output import to_json
from slider_resonator.trials.hosts.step_cost import StepCost, measure_steps


@click.command("bench")
@click.argument("fmu", type=click.Path(path_type=Path), required=False)
@click.option("--repeats", type=click.IntRange(min=1), default=9, show_default=True)
@json_option
def bench_command(fmu: Path | None, repeats: int, as_json: bool) -> None:
    """Measure what a communication step costs in a C host: set an input, step, get outputs.

    Needs a C compiler, and an FMU that runs without Python; without FMU: the one in dist. `trade`
    measures error over cost, of other methods too. Exit code: 0, or 2 when it could not run.

    \b
    Examples:
      python -m harness bench
      python -m harness bench my.fmu --repeats 11 --json
    """
    with progress_bar() as progress, open_fmu(default_fmu(fmu)) as opened:
        if not opened.runs_without_python:
            raise FmuError(f"{opened.path}: needs a Python interpreter, which a C host is without")
        costs = measure_steps(opened.path, repeats, progress)
    if as_json:
        click.echo(to_json({"c_host": costs}))
    else:
        output().print(_table(costs))
        click.echo(f"Medians of {repeats} repeats in turn.")


def _table(costs: Sequence[StepCost]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("step", no_wrap=True)
    for heading in ("outputs read", "us", "fastest-slowest"):
        table.add_column(heading, justify="right", no_wrap=True)
    for cost in costs:
        spread = f"{cost.fastest:.2f}-{cost.slowest:.2f}"
        table.add_row(cost.name, str(cost.outputs), f"{cost.microseconds:.2f}", spread)
    return table
