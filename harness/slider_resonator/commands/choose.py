"""`choose`: find the cheapest model that meets a scene's needs, by runs in the FMU."""

from pathlib import Path

import click

from slider_resonator.choosing.choosing import TIME_LIMIT, choose
from slider_resonator.commands import options
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import print_result
from slider_resonator.output.progress import progress_bar
from slider_resonator.scenes.needs import AllowedTable, allowed_error


@click.command("choose", cls=options.SettingsCommand)
@click.argument("scene", default="table_1")
@click.option(
    "--need",
    "needs",
    type=options.Parsed(
        "NAME=ERROR",
        lambda name, error: (name, allowed_error(name, error)),
        "(.*?)=(.*)",
        "mean_velocity='1 %'",
    ),
    multiple=True,
    callback=options.each_once,
    help="A quantity and its allowed error, as mean_velocity='1 %' or position='2 um', in place of "
    "[need]. Repeatable.",
)
@options.stop_time_option
@options.step_option("The sampling step of signals, such as position")
@options.fmu_option
@options.device_options
@options.time_limit_option(TIME_LIMIT, "For the whole choice.")
@options.json_option
def choose_command(
    scene: str,
    needs: dict[str, AllowedTable],
    stop_time: float | None,
    step_size: float | None,
    fmu: Path,
    given: options.Given,
    time_limit: float,
    as_json: bool,
) -> int:
    """Choose fidelity, friction law, tolerance and communication step for what a scene needs.

    The scene, built in or from a file, by default table_1, states its needs in [need], or --need
    does: any of mean_velocity (at the end), mean_velocity_throughout, position, velocity,
    steady_velocity, blocking_force, event_times and beat, each with abs or rel; [need] may also
    have friction_law = "free" if either law will do. Candidates are run in the FMU, which gives
    their errors and their CPU times. The scene's own fidelity and tolerance are ignored; its step,
    of several the largest, is the sampling step of signals. Inputs are held over each step, or go
    on as straight lines where [run] says interpolate and the FMU can; tuned parameters are held. A
    scene with a sweep stands for its unvaried device. The last digits of the cost differ from call
    to call; where costs differ by less than 5 %, the model that leaves out least is chosen. Exit
    code: 0 when a model meets the needs, 1 when none does (then the nearest is shown), 2 when the
    scene could not run, the FMU crashed or exceeded the time limit.

    \b
    Examples:
      slider-resonator choose --device mine.toml --time "200 ms" --need mean_velocity="1 %"
      slider-resonator choose --device mine.toml --time "1 s" --step "1 ms" --need position="2 um"
      slider-resonator choose feed_forward
      slider-resonator choose scenes/mine.toml --json
      slider-resonator choose feed_forward --set friction_law=1 bristle_stiffness=1e6
    """
    given.check_left_to_choose()
    read = given.scene(scene).timed(stop_time=stop_time, step_size=step_size)
    if needs:
        read = read.needing(needs)
    provenance = provenance_of(fmu)
    with progress_bar() as progress:
        choice = choose(read, fmu, time_limit, progress)
    print_result(choice, choice.describe(), as_json=as_json, provenance=provenance)
    return 0 if choice.meets else 1
