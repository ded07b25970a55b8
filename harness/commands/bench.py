"""`bench`: cost and error side by side."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import click
from rich import box
from rich.console import Console
from rich.table import Table

from harness.benchmark.c_host import STEPS, StepCost, measure_steps, short_step_ratio
from harness.benchmark.cost import Cost, Ratio
from harness.benchmark.coulomb import CoulombBenchmark, measure_coulomb
from harness.benchmark.lugre import CASES, EQUAL_ERROR, LugreBenchmark, measure_lugre
from harness.commands.options import default_fmus, json_option
from harness.console import output, progress_bar
from harness.drive import instantiate
from harness.fmu import open_fmu
from harness.json_output import to_json

PARTS = ("coulomb", "lugre", "c-host")


@dataclass(frozen=True)
class Benchmarks:
    """What was measured; None or empty for what was not asked for."""

    coulomb: CoulombBenchmark | None
    lugre: tuple[LugreBenchmark, ...]
    c_host: tuple[StepCost, ...]


@click.command("bench")
@click.argument("fmus", type=click.Path(path_type=Path), nargs=-1)
@click.option("--repeats", type=click.IntRange(min=1), default=9, show_default=True)
@click.option(
    "--part",
    "parts",
    type=click.Choice(PARTS),
    multiple=True,
    default=PARTS,
    help="What to measure; may be given more than once.  [default: all]",
)
@json_option
def bench_command(
    fmus: tuple[Path, ...], repeats: int, parts: tuple[str, ...], as_json: bool
) -> None:
    """Measure what a drive period costs and how exact it is, FMUs and peers in one run.

    The device is that of table 1 near its steady motion, errors are against Taylor integration with
    located events. Needs heyoka, and scikit-sundae for LuGre friction (pip install
    'slider-resonator[peers]'); `c-host` needs a C compiler and an FMU that runs without Python.
    Leaves with 0, or with 2 when it could not be run.

    \b
    Examples:
      python -m harness bench
      python -m harness bench my.fmu --part coulomb --repeats 11 --json
    """
    paths = fmus or default_fmus()
    coulomb: CoulombBenchmark | None = None
    lugre: list[LugreBenchmark] = []
    c_host: list[StepCost] = []
    with ExitStack() as stack:
        progress = stack.enter_context(progress_bar())
        opened = [stack.enter_context(open_fmu(path)) for path in paths]
        instances = {fmu.path.name: stack.enter_context(instantiate(fmu)) for fmu in opened}
        if "coulomb" in parts:
            coulomb = measure_coulomb(instances, repeats, progress)
        if "lugre" in parts:
            lugre = [measure_lugre(instances, case, repeats, progress) for case in CASES]
        for fmu in opened:
            if "c-host" in parts and fmu.runs_without_python:
                c_host += measure_steps(fmu.path, repeats, progress)
    measured = Benchmarks(coulomb, tuple(lugre), tuple(c_host))
    if as_json:
        click.echo(to_json(measured))
    else:
        _print(output(), measured, repeats)


def _print(console: Console, measured: Benchmarks, repeats: int) -> None:
    if measured.coulomb is not None:
        console.print("Coulomb friction", style="bold")
        console.print(_costs(measured.coulomb.costs))
        console.print(
            "A relative tolerance alone does not determine the cost of DOP853 on sgn: the absolute "
            "one counts\nas much. So it is shown, and compared, at each atol; none of them stands "
            "for the method."
        )
        _print_ratios(console, measured.coulomb.ratios)
    for lugre in measured.lugre:
        console.print(f"\nLuGre friction, bristle_stiffness {lugre.stiffness:g} 1/m", style="bold")
        console.print(_costs(lugre.costs))
        console.print(f"At errors of at most {EQUAL_ERROR:g}, each at the cheapest tolerance:")
        for cost in lugre.most_exact_of_the_others:
            console.print(f"Never that exact, so shown at its best: {cost.method}", markup=False)
        _print_ratios(console, lugre.ratios)
    if measured.c_host:
        console.print("\nOne communication step from a host in C: set, step, get", style="bold")
        console.print(_steps(measured.c_host))
        for begin in range(0, len(measured.c_host), len(STEPS)):
            ratio = short_step_ratio(measured.c_host[begin : begin + len(STEPS)])
            console.print(f"A period costs {ratio:.2f} x as much in steps of one as in long steps.")
    console.print(
        f"Medians of {repeats} repeats in turn; errors over the peak, at the ends of drive periods."
    )


def _costs(costs: Sequence[Cost]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("method", no_wrap=True)
    headings = (
        *("us per\nperiod", "fastest-\nslowest", "position\nerror", "velocity\nerror"),
        *("periods\nrun", "rever-\nsals", "\nsteps", "evalua-\ntions"),
    )
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    for cost in costs:
        table.add_row(
            cost.method,
            _short(cost.microseconds),
            f"{_short(cost.fastest)}-{_short(cost.slowest)}",
            "referee" if cost.position_error is None else f"{cost.position_error:.1e}",
            "referee" if cost.velocity_error is None else f"{cost.velocity_error:.1e}",
            str(cost.periods),
            "-" if cost.reversals is None else str(cost.reversals),
            str(cost.steps),
            "-" if cost.evaluations is None else str(cost.evaluations),
        )
    return table


def _steps(costs: Sequence[StepCost]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("step", no_wrap=True)
    for heading in ("outputs read", "us", "fastest-slowest"):
        table.add_column(heading, justify="right", no_wrap=True)
    for cost in costs:
        spread = f"{cost.fastest:.2f}-{cost.slowest:.2f}"
        table.add_row(cost.name, str(cost.outputs), f"{cost.microseconds:.2f}", spread)
    return table


def _print_ratios(console: Console, ratios: Sequence[Ratio]) -> None:
    against = ""
    for ratio in ratios:
        if ratio.against != against:
            against = ratio.against
            console.print(f"Against {against}:", markup=False)
        error = (
            "" if ratio.velocity_error is None else f" at {ratio.velocity_error:.1e} x the error"
        )
        console.print(f"  {ratio.method}: {ratio.time:,.1f} x the time{error}", markup=False)


def _short(microseconds: float) -> str:
    if microseconds >= 100.0:
        return f"{microseconds:,.0f}"
    return f"{microseconds:.1f}" if microseconds >= 10.0 else f"{microseconds:.2f}"
