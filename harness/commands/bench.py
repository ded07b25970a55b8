"""`bench`: cost and error side by side."""

from __future__ import annotations

from pathlib import Path

import click
from rich import box
from rich.console import Console
from rich.table import Table

from harness.bench import COMPARED, Benchmark, bench
from harness.commands.options import default_fmu, json_option
from harness.console import output, progress_bar
from harness.json_output import to_json


@click.command("bench")
@click.argument("fmu", type=click.Path(path_type=Path), required=False)
@click.option("--repeats", type=click.IntRange(min=1), default=5, show_default=True)
@json_option
def bench_command(fmu: Path | None, repeats: int, as_json: bool) -> None:
    """Measure what a drive period costs and how exact it is, FMU and references in one run.

    The device is that of table 1 from rest, errors are against Taylor integration with located
    events. Needs heyoka (pip install 'slider-resonator[referee]'). Leaves with 0, or with 2 when it
    could not be run.

    \b
    Examples:
      python -m harness bench
      python -m harness bench my.fmu --repeats 11 --json
    """
    with progress_bar() as progress:
        benchmark = bench(default_fmu(fmu), repeats, progress)
    if as_json:
        click.echo(to_json(benchmark))
    else:
        _print(output(), benchmark)


def _print(console: Console, benchmark: Benchmark) -> None:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("method", no_wrap=True)
    headings = (
        *("us per\nperiod", "fastest-\nslowest", "position\nerror", "velocity\nerror"),
        *("periods\nrun", "rever-\nsals", "\nsteps", "evalua-\ntions"),
    )
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    for cost in benchmark.costs:
        table.add_row(
            cost.method,
            _short(cost.microseconds),
            f"{_short(cost.fastest)}-{_short(cost.slowest)}",
            "referee" if cost.position_error is None else f"{cost.position_error:.1e}",
            "referee" if cost.velocity_error is None else f"{cost.velocity_error:.1e}",
            str(cost.periods),
            str(cost.reversals),
            str(cost.steps),
            "-" if cost.evaluations is None else str(cost.evaluations),
        )
    console.print(table)
    console.print(
        "A relative tolerance alone does not determine the cost of DOP853 on sgn: the absolute one "
        "counts as\nmuch. So it is shown, and compared, at each atol; none of them stands for "
        "the method."
    )
    console.print(
        f"Medians of {benchmark.repeats} repeats in turn; errors over the peak, at the ends of "
        f"drive periods.\nAgainst the FMU in steps of {COMPARED} periods:"
    )
    for ratio in benchmark.ratios:
        error = (
            "" if ratio.velocity_error is None else f" at {ratio.velocity_error:.1e} x the error"
        )
        console.print(f"  {ratio.method}: {ratio.time:,.1f} x the time{error}", markup=False)


def _short(microseconds: float) -> str:
    return f"{microseconds:,.0f}" if microseconds >= 100.0 else f"{microseconds:.1f}"
