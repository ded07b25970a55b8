"""`run`: run one scene, write CSV and picture, report the cost."""

from collections.abc import Mapping, Sequence
from functools import partial
from operator import attrgetter
from pathlib import Path
from typing import Any

import click

from slider_resonator.choosing.choice import INPUTS, Choice
from slider_resonator.commands import options
from slider_resonator.device.schedule import Schedule
from slider_resonator.device.units import si_number
from slider_resonator.fmu.isolation.process import TIME_LIMIT, IsolatedFmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.fmu.run import Record, run
from slider_resonator.output.console import print_result
from slider_resonator.output.files import PICTURE_SUFFIXES, distinct, write_csv
from slider_resonator.output.progress import Progress, progress_bar
from slider_resonator.output.readable import number_of, one_line, readable
from slider_resonator.scenes.scene import Scene


def _window(begin: str, end: str) -> tuple[float, float]:
    """Return two times in s; ValueError for other texts."""
    return si_number("time", begin, "s"), si_number("time", end, "s")


def _overlay(text: str) -> tuple[str, float] | Path:
    """Return the setting NAME=VALUE, or the path of an FMU; ValueError for a wrong setting."""
    if Path(text).is_file() or "=" not in text:
        return Path(text)
    return options.setting(*text.split("=", 1))


@click.command("run", cls=options.SettingsCommand)
@options.fmu_argument
@click.argument("scene", required=False)
@options.stop_time_option
@options.step_option("The communication step")
@click.option("--out", type=options.target([".csv"]), help="CSV file of the run.")
@click.option(
    "--plot",
    type=options.target(PICTURE_SUFFIXES),
    help="PNG, SVG or PDF of the run, drawn from a second run with finer steps at the end.",
)
@click.option(
    "--signals",
    type=options.Parsed("NAME,...", lambda text: [name.strip() for name in text.split(",")]),
    help="With --plot: the outputs, inputs and tuned parameters to draw, a panel each, in place of "
    "the usual panels.",
)
@click.option(
    "--window",
    type=options.Parsed("FROM:TO", _window, "(.+?):(.+)", "0.1:0.11 or 5 ms:6 ms"),
    help="With --plot: the time to draw, in s or with a unit, in steps fine enough to be smooth.",
)
@click.option(
    "--overlay",
    "overlays",
    type=options.Parsed("NAME=VALUE|FMU", _overlay),
    multiple=True,
    help="With --plot: draw a further run, with a setting such as fidelity=1 or of another FMU. "
    "Repeatable.",
)
@click.option(
    "--auto",
    is_flag=True,
    help="Run with the cheapest fidelity, tolerance and step that meet the scene's [need], as the "
    "command choose finds them.",
)
@click.option(
    "--interpolate/--no-interpolate",
    default=None,
    help="Pass ramps, and CSV inputs with between linear, on as derivatives, or hold them over "
    "each step. An FMU without canInterpolateInputs holds them.  [default: as [run] of the scene "
    "says, which holds them unless it has interpolate]",
)
@options.device_options
@options.time_limit_option(
    TIME_LIMIT, "For each of the choice, the run and the run for the picture."
)
@options.json_option
def run_command(
    fmu: Path,
    scene: str,
    stop_time: float | None,
    step_size: float | None,
    out: Path | None,
    plot: Path | None,
    signals: Sequence[str] | None,
    window: tuple[float, float] | None,
    overlays: tuple[tuple[str, float] | Path, ...],
    auto: bool,
    interpolate: bool | None,
    given: options.Given,
    time_limit: float,
    as_json: bool,
) -> int:
    """Run one scene, built in or from a file, and report the cost.

    Without SCENE it is table_1: 100 drive periods from rest, with --device of a device of yours. A
    scene with a sweep runs with the unvaried device; --set varies it. Nothing is judged. Exit code:
    0, or 2 when the FMU could not run, crashed or exceeded the time limit; with --auto 1, without a
    run, when no model meets the scene's needs.

    \b
    Examples:
      slider-resonator run --device mine.toml --time "50 ms" --plot start.png
      slider-resonator run --device mine.toml --time "100 s" --step "10 ms" --set fidelity=0
      slider-resonator run table_1
      slider-resonator run my.fmu table_1 --out table_1.csv --plot table_1.png
      slider-resonator run my.fmu feed_forward --auto
      slider-resonator run my.fmu changing_inputs --interpolate
      slider-resonator run my.fmu table_1 --plot a.png --window 0.1:0.11 --overlay fidelity=1
      slider-resonator run my.fmu scenes/mine.toml --set load=0.05 phase=0.4 --json
    """
    read = given.scene(scene).timed(stop_time=stop_time, step_size=step_size)
    if interpolate is not None:
        read = read.interpolating(interpolate)
    files = {f"the scene's file {file}": file for file in read.files}
    others = {f"the FMU {one}": one for one in overlays if isinstance(one, Path)}
    distinct({"--out": out, "--plot": plot}, {"the FMU": fmu, **others, **files, **given.sources})
    is_chosen = bool(signals is not None or window or overlays)
    if plot is None and is_chosen:
        raise click.UsageError("--signals, --window and --overlay need --plot")
    if auto and step_size is not None:
        raise click.UsageError("--step and --auto exclude each other: --auto chooses the step")
    if auto:
        given.check_left_to_choose()
    choice: Choice | None = None
    provenance = provenance_of(fmu, *others.values())
    if is_chosen:
        # Imported here: drawing takes longer to load than the rest to run.
        from slider_resonator.scenes.run_plots import check_plot

        check_plot(read, signals or (), window)
    with progress_bar() as progress, IsolatedFmu(fmu, time_limit) as isolated:
        if auto:
            # Imported here: it loads scipy.
            from slider_resonator.choosing.choosing import choose_with

            read.schedule()
            chosen: Choice = isolated.run(partial(choose_with, scene=read), progress)
            if not chosen.meets:
                lines = chosen.sentences()
                print_result(chosen, lines, as_json=as_json, provenance=provenance)
                return 1
            choice, read = chosen, chosen.applied_to(read)
        how = read.lines_reach(isolated.run(attrgetter("fmu.interpolates")))
        if how == "cannot":
            read = read.interpolating(False)
        record = _run(isolated, read, read.schedule(), progress)
        if out is not None:
            columns = record.table()
            rows = zip(*(column.tolist() for column in columns.values()), strict=True)
            write_csv(out, columns, rows)
        if is_chosen and plot is not None:
            shown = window or (0.0, float(record.times[-1]))
            _draw_signals(isolated, fmu, read, signals, shown, overlays, plot, time_limit, progress)
        elif plot is not None:
            from slider_resonator.output.plot_style import save
            from slider_resonator.scenes.run_plots import run_figure, schedule_to_plot

            fine = _run(isolated, read, schedule_to_plot(read), progress)
            save(run_figure(fine, read), plot)
    summary = _summary(fmu, read, record, out=out, plot=plot, auto=choice, inputs=how)
    print_result(summary, _sentences(summary, read), as_json=as_json, provenance=provenance)
    return 0


def _run(isolated: IsolatedFmu, scene: Scene, schedule: Schedule, progress: Progress) -> Record:
    task = partial(run, parameters=scene.parameters, schedule=schedule)
    record: Record = isolated.run(task, lambda _, share: progress(scene.name, share))
    return record


def _draw_signals(
    isolated: IsolatedFmu,
    fmu: Path,
    scene: Scene,
    signals: Sequence[str] | None,
    window: tuple[float, float],
    overlays: Sequence[tuple[str, float] | Path],
    path: Path,
    time_limit: float,
    progress: Progress,
) -> None:
    """Run the scene, and again for each overlay, and draw a window (s); by default `SIGNALS`.

    With overlays differences are drawn, too. Raises HarnessError for a setting that the scene
    refuses, and as `IsolatedFmu` does.
    """
    from slider_resonator.scenes.run_plots import SIGNALS, Run, plot_signals, schedule_for_window

    def drawn(on: IsolatedFmu, label: str, varied: Scene) -> Run:
        interpolates = varied.schedule().interpolates and on.run(attrgetter("fmu.interpolates"))
        schedule = schedule_for_window(varied.interpolating(interpolates), window)
        return label, _run(on, varied, schedule, progress).table()

    runs = [drawn(isolated, fmu.name, scene)]
    for overlay in overlays:
        if isinstance(overlay, Path):
            with IsolatedFmu(overlay, time_limit) as other:
                runs.append(drawn(other, overlay.name, scene))
        else:
            name, value = overlay
            runs.append(drawn(isolated, f"{name} {value:g}", scene.with_values({name: value})))
    plot_signals(runs, scene, signals or SIGNALS, window, path)


def _summary(
    fmu: Path, scene: Scene, record: Record, **more: Path | Choice | str | None
) -> dict[str, Any]:
    """Return a run and its cost; times in s, positions in m, velocities in m/s.

    Of `more`, `auto` is the choice of --auto, `inputs` how inputs that are straight lines reach the
    FMU: one of `INPUTS`, None where there are none.
    """
    simulated = float(record.times[-1])
    periods = float(scene.drive_periods.passed_by(record.times[-1:])[0])
    return {
        "fmu": str(fmu),
        "scene": scene.name,
        "simulated_time": simulated,
        "drive_periods": periods,
        "communication_steps": len(record.times) - 1,
        "position": record.final("position"),
        "mean_velocity": record.final("mean_velocity"),
        "reversals": round(record.final("reversals")),
        "stick_fraction": record.final("stick_fraction"),
        "last_event_time": record.final("last_event_time"),
        "wall_time": record.wall_time,
        "wall_time_per_simulated_time": record.wall_time / simulated,
        "microseconds_per_drive_period": 1e6 * record.wall_time / periods,
        **more,
    }


def _sentences(summary: Mapping[str, Any], scene: Scene) -> list[str]:
    lines = [] if summary["auto"] is None else summary["auto"].sentences()
    lines += [
        f"scene    {scene.name}: {one_line(scene.title)}",
        f"FMU      {one_line(summary['fmu'])}",
        f"run      {summary['simulated_time']:.6g} s, {summary['drive_periods']:.6g} drive periods "
        f"in {number_of(summary['communication_steps'], 'communication step')}",
        f"result   position {readable(summary['position'], 9)} m, mean velocity over the last "
        f"drive period {readable(summary['mean_velocity'], 9)} m/s",
    ]
    if summary["inputs"]:
        lines.append(f"inputs   {INPUTS[summary['inputs']]}")
    if scene.device.fidelity != 0:  # averaged motion has no events to count
        lines.append(
            f"contact  {number_of(summary['reversals'], 'reversal')}, sticking "
            f"{summary['stick_fraction']:.1%} of the last drive period, "
            f"last event at {summary['last_event_time']:.9g} s"
        )
    lines.append(
        f"cost     {summary['wall_time']:.3g} s of wall time, "
        f"{summary['wall_time_per_simulated_time']:.3g} per simulated second, "
        f"{summary['microseconds_per_drive_period']:.3g} us per drive period"
    )
    written = (summary["out"], summary["plot"])
    return lines + [f"written  {one_line(str(file))}" for file in written if file]
