"""`trade`: measure error over cost of the FMUs' models and of other methods."""

from collections.abc import Sequence
from pathlib import Path

import click

from slider_resonator.commands import options
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import noting_on_interrupt, print_result
from slider_resonator.output.files import PICTURE_SUFFIXES, distinct, make_folder
from slider_resonator.output.progress import part_of, progress_bar
from slider_resonator.output.readable import one_line
from slider_resonator.trading import result
from slider_resonator.trading.measure import BUDGET, REPEATS, TIME_LIMIT, measure_trade, opened
from slider_resonator.trading.page import draw_picture, write_trades
from slider_resonator.trading.problem import problem_of

TABLES = ("index.html", "trade.csv", "omissions.csv")


@click.command("trade", cls=options.SettingsCommand)
@click.argument("scenes", nargs=-1)
@options.out_folder_option("trade.csv, omissions.csv and index.html")
@click.option(
    "--fmu",
    "fmus",
    type=options.FMU_FILE,
    multiple=True,
    help="FMU to measure. Repeatable.  [default: those in dist]",
)
@click.option(
    "--repeats",
    type=click.IntRange(min=1),
    default=REPEATS,
    help="Repeats of each method, in turn with the others; fewer when its budget is spent.",
)
@click.option(
    "--budget",
    type=click.FloatRange(min=0.0, min_open=True),
    default=BUDGET,
    help="CPU time in s for the longest run of a method or its search for steady motion, and the "
    "same again for repeats.",
)
@click.option(
    "--periods", type=click.IntRange(min=1), help="Shorten runs to this many drive periods."
)
@click.option(
    "--picture",
    type=options.target(PICTURE_SUFFIXES),
    help="Picture of the first scene for the README.",
)
@click.option(
    "--page",
    "pages",
    type=options.target(result.SUFFIXES),
    multiple=True,
    help="Markdown or HTML file for the tables from need to model to cost, which go between the "
    "lines <!-- trade --> and <!-- end of trade --> if the file has them. Repeatable.",
)
@options.device_options
@options.time_limit_option(TIME_LIMIT, "For each run and search of an FMU.")
@options.json_option
def trade_command(
    scenes: Sequence[str],
    given: options.Given,
    out: Path,
    fmus: Sequence[Path],
    repeats: int,
    budget: float,
    periods: int | None,
    picture: Path | None,
    pages: Sequence[Path],
    time_limit: float,
    as_json: bool,
) -> None:
    """Measure error and cost of every model of the FMUs and of other methods on scenes.

    Rows are fidelities, friction laws, communication steps and tolerances, and peers on the same
    equations; columns are errors relative to Taylor integration with located events, CPU time and
    counts. SCENES are built-in names or files, by default table_1; each point of a sweep is
    measured. The reference is always the scene's full device, at whatever fidelity the scene runs.
    Peers follow inputs that are straight lines, and so do FMUs with canInterpolateInputs; other
    FMUs hold them over each step. Scenes with constant inputs run for at least 1000 drive
    periods. One of the peers needs heyoka (pip install 'slider-resonator[taylor]') and is left
    out without it. Exit code: 0, or 2 when it could not run, an FMU refuses the scene, crashed or
    exceeded the time limit; the tables of the scenes before are kept.

    \b
    Examples:
      slider-resonator trade --out trade
      slider-resonator trade table_1 lugre detuned_beat --out trade --picture trade.png
      slider-resonator trade table_1 --device mine.toml --out trade
      slider-resonator trade my.toml --out trade --fmu my.fmu --json
    """
    tables = {f"{name} of --out": out / name for name in TABLES}
    documents = {f"--page {number}": page for number, page in enumerate(pages, 1)}
    distinct({**tables, "--picture": picture, **documents}, {})
    names = scenes or ("table_1",)
    read = [given.scene(name) for name in names]
    points = [point for scene in read for point in scene.points()]
    problems = [problem_of(point.scene, point.at, periods) for point in points]
    paths = fmus or options.default_fmus()
    provenance = provenance_of(*paths)
    trades: list[result.Trade] = []
    with (
        opened(paths, time_limit) as instances,
        noting_on_interrupt(lambda: f"{len(trades)} of {len(problems)} scenes are kept in {out}"),
        progress_bar() as progress,
    ):
        make_folder(out)
        for index, problem in enumerate(problems):
            part = part_of(progress, index, len(problems))
            trades.append(measure_trade(problem, instances, part, repeats=repeats, budget=budget))
            # After each scene, so that a later failure does not lose minutes of measurement.
            page, rows, omissions = tables.values()
            result.write_tables(rows, omissions, trades)
            write_trades(page, trades, provenance)
    if picture is not None:
        draw_picture(trades[0], picture)
    for page in pages:
        result.write_choices(page, trades)
    lines = [one_line(line) for trade in trades for line in trade.describe()]
    written = [*tables.values(), *([] if picture is None else [picture]), *pages]
    lines.append(f"written {one_line(', '.join(map(str, written)))}")
    entries = [{"trade": trade, "standings": result.standings(trade)} for trade in trades]
    print_result(entries, lines, as_json=as_json, provenance=provenance)
