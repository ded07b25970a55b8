"""`bench`: the cost of a communication step in a C host."""

from collections.abc import Sequence
from pathlib import Path

import click

from slider_resonator.commands.options import fmu_argument, json_option, time_limit_option
from slider_resonator.errors import FmuError
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import noting_on_interrupt, print_result
from slider_resonator.output.progress import progress_bar
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Table, numbers, texts
from studies.hosts.step_cost import StepCost, leap_gains, measure_steps, short_step_ratio


@click.command("bench")
@fmu_argument
@click.option(
    "--repeats",
    type=click.IntRange(min=1),
    default=9,
    help="How often each kind of step is timed; the median is reported.",
)
@time_limit_option(TIME_LIMIT, "For each run of the driver.")
@json_option
def bench_command(fmu: Path, repeats: int, time_limit: float, as_json: bool) -> None:
    """Measure what a communication step costs in a C host: set an input, step, get outputs.

    Needs a C compiler, and an FMU that runs without Python; without FMU: the one in dist. `trade`
    measures error over cost, of other methods too. Exit code: 0, or 2 when it could not run.

    \b
    Examples:
      python -m harness bench
      python -m harness bench my.fmu --repeats 11 --json
    """
    provenance = provenance_of(fmu)
    with noting_on_interrupt(), progress_bar() as progress, open_fmu(fmu) as opened:
        if not opened.runs_without_python:
            raise FmuError(f"{opened.path}: needs a Python interpreter, which a C host lacks")
        costs = measure_steps(opened.path, repeats, progress, time_limit)
    ratio, gains = short_step_ratio(costs), leap_gains(costs)
    found = {"c_host": costs, "short_step_ratio": ratio, "leap_gains": gains}
    lines = [
        f"A period costs {ratio:.2f} times as much in steps of one as in long steps.",
        f"Leaps over 20 s cost {gains[0]:.3g} times less than resolved motion, "
        f"{gains[1]:.3g} times less at 35 000 rad/s.",
        f"Medians of {number_of(repeats, 'repeat')} in turn; the ratios are those of the fastest.",
    ]
    print_result(found, _table(costs), lines, as_json=as_json, provenance=provenance)


def _table(costs: Sequence[StepCost]) -> Table:
    columns = (*texts("step"), *numbers("outputs read", "us", "fastest-slowest"))
    rows = [
        (c.name, str(c.outputs), f"{c.microseconds:.2f}", f"{c.fastest:.2f}-{c.slowest:.2f}")
        for c in costs
    ]
    return Table(columns, rows)
