"""`sweep`: collect thousands of runs in one table."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import click

from slider_resonator.commands import options
from slider_resonator.device.interface import SETTABLE, VARIABLES
from slider_resonator.errors import unknown_name
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import print_result
from slider_resonator.output.files import PICTURE_SUFFIXES, distinct
from slider_resonator.output.progress import progress_bar
from slider_resonator.output.readable import one_line
from slider_resonator.sweeping.grid import grid_from, read_grid
from slider_resonator.sweeping.sweeping import SUFFIXES, run_sweep


def _axis(name: str, first: str, last: str, count: str) -> tuple[str, dict[str, float]]:
    """Return a name and a range in SI units; ValueError for other texts."""
    if name not in SETTABLE:
        raise ValueError(unknown_name("parameter or input", name, SETTABLE))
    begin, end = map(VARIABLES[name].in_si, (first, last))
    return name, {"from": begin, "to": end, "count": int(count)}


@click.command("sweep", cls=options.SettingsCommand)
@click.argument("grid", type=click.Path(path_type=Path), required=False)
@click.option(
    "--over",
    "axes",
    type=options.Parsed(
        "NAME=FROM:TO:COUNT",
        _axis,
        r"\s*(\w+)=([^:]+):([^:]+):(\d+)\s*",
        "'phase=-180 deg:180 deg:73'",
    ),
    multiple=True,
    callback=options.each_once,
    help="In place of GRID: a range of a parameter or input, in SI units or with units. "
    "Repeatable.",
)
@click.option(
    "--measure",
    "measures",
    metavar="NAME",
    multiple=True,
    help="With --over: what to compute. Repeatable.  [default: steady_velocity]",
)
@click.option("--out", type=options.target(SUFFIXES), required=True, help="Table to write.")
@click.option(
    "--plot", type=options.target(PICTURE_SUFFIXES), help="Picture of the results: lines or map."
)
@click.option("--html", type=options.target([".html"]), help="One page with plots to point at.")
@options.device_options
@options.fmu_option
@options.jobs_option
@click.option("--dask", metavar="ADDRESS", help="Run on the cluster of this scheduler.")
@click.option("--restart", is_flag=True, help="Discard the points of an earlier attempt.")
@click.option("--overwrite", is_flag=True, help="Replace a table that exists.")
@options.time_limit_option(TIME_LIMIT, "For each point; one that takes longer fails.")
@options.json_option
def sweep_command(
    grid: Path | None,
    axes: dict[str, dict[str, float]],
    measures: Sequence[str],
    out: Path,
    plot: Path | None,
    html: Path | None,
    given: options.Given,
    fmu: Path,
    jobs: int,
    dask: str | None,
    restart: bool,
    overwrite: bool,
    time_limit: float,
    as_json: bool,
) -> int:
    """Compute measures over a grid, a list or a random sample of parameters and inputs.

    Finished points are kept beside the table until it is written: after an interruption, even a
    kill, the same command continues and writes the same table, byte for byte, with any number of
    workers anywhere. A point that fails is a row with its error; one without an answer, such as a
    steady velocity that does not exist, is counted and drawn as such. Exit code: 0, 1 when a point
    fails, 2 when the sweep could not run.

    \b
    A grid file:
      measures = ["steady_velocity", "blocking_force", "velocity.rms"]
      [fixed]
      load = 0.01
      [grid]
      frequency_ratio = { from = 0.5, to = 5.5, count = 101 }
      phase = [0.0, 0.4, 0.8]

    [list] has parallel lists, [random] count, seed and ranges; the points of all three are
    combined. A range may have spacing = "log". OUTPUT.STATISTIC (mean, rms, minimum, maximum,
    peak_to_peak, last) is taken over a run from the initial state: [run] has drive_periods, by
    default 100, steps_per_period (16) and skip_periods (0).

    \b
    Examples:
      slider-resonator sweep --over "phase=-180 deg:180 deg:73" --out curve.csv --plot curve.png
      slider-resonator sweep --over load=0:200mN:41 --set phase="30 deg" --out curve.csv
      slider-resonator sweep grid.toml --out table.parquet --plot map.png
      slider-resonator sweep grid.toml --out table.csv --device mine.toml --jobs 4
      slider-resonator sweep grid.toml --out table.csv --html sweep.html
      slider-resonator sweep grid.toml --out table.parquet --dask tcp://192.0.2.1:8786
    """
    if (grid is None) == (not axes) or (measures and not axes):
        raise click.UsageError("must have either GRID or --over, and --measure with that only")
    sources = {"the FMU": fmu} | ({"the grid": grid} if grid is not None else {})
    distinct({"--out": out, "--plot": plot, "--html": html}, sources)
    device = given.device
    own = device.values if device else {}
    if grid is not None:
        sweep = read_grid(grid, own, given.settings)
    else:
        content = {"grid": axes, **({"measures": list(measures)} if measures else {})}
        sweep = grid_from(content, "--over", own, given.settings)
    options.note(sweep.slips, str(grid or "--over"))
    if device and not sweep.title:
        sweep = replace(sweep, title=device.title)
    if plot is not None or html is not None:
        # Imported here: drawing takes longer to load than many sweeps to run.
        from slider_resonator.sweeping.picture import check_picture, write_sweep_page

        check_picture(sweep, "--html" if plot is None else "--plot")
    provenance = provenance_of(fmu)
    with progress_bar() as progress:
        result = run_sweep(
            sweep,
            fmu,
            out,
            workers=jobs,
            dask=dask,
            restart=restart,
            overwrite=overwrite,
            time_limit=time_limit,
            progress=progress,
        )
    if plot is not None:
        result.plot(plot)
    if html is not None:
        write_sweep_page(html, sweep, result.columns, provenance)
    facts = ("points", "found", "failed", "unanswered", "first_error")
    document = {"out": str(out)} | {name: getattr(result, name) for name in facts}
    written = ", ".join(map(str, [out, *filter(None, (plot, html))]))
    lines = [*result.sentences(), f"written    {one_line(written)}"]
    print_result(document, lines, as_json=as_json, provenance=provenance)
    return 1 if result.failed else 0
