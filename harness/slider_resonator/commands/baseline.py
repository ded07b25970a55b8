"""`baseline`: record, check and accept golden results."""

from pathlib import Path

import click

from slider_resonator.baseline.golden import TOLERANCE
from slider_resonator.baseline.work import accept, check, record
from slider_resonator.commands.options import fmu_argument, scenes_option, time_limit_option
from slider_resonator.commands.reports import Reports, print_run_failures, report_options
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.output.console import print_text
from slider_resonator.output.progress import progress_bar
from slider_resonator.output.readable import number_of, one_line
from slider_resonator.scenes.scene_files import find_scenes

dir_option = click.option(
    "--dir",
    "folder",
    type=click.Path(path_type=Path, file_okay=False),
    required=True,
    help="Folder of the baseline: CSV files to keep under version control.",
)
limited = time_limit_option(TIME_LIMIT, "For each scene, or point of a sweep.")


@click.group("baseline")
def baseline_command() -> None:
    """Keep an FMU's results under version control and compare with them.

    A baseline has a folder for each scene: steady velocity, blocking force, counts, some points of
    the run and their provenance, in CSV files. validate compares an FMU with physics; a baseline
    compares it with its own earlier results.

    \b
    Examples:
      slider-resonator baseline record my.fmu --dir baseline
      slider-resonator baseline check my.fmu --dir baseline --html changes.html
      slider-resonator baseline accept my.fmu --dir baseline
    """


@baseline_command.command("record")
@fmu_argument
@dir_option
@scenes_option("all built-in that apply")
@click.option("--replace", is_flag=True, help="Replace scenes that are already recorded.")
@limited
def record_command(
    fmu: Path, folder: Path, scenes: tuple[str, ...], replace: bool, time_limit: float
) -> int:
    """Record scenes, by default all built-in ones that apply to the FMU.

    Recorded scenes are replaced only with --replace. Exit code: 0, or 2 when something could not
    run; the scenes that could run are recorded.

    \b
    Examples:
      slider-resonator baseline record my.fmu --dir baseline
      slider-resonator baseline record my.fmu --dir baseline --scene scenes/mine.toml --replace
    """
    with progress_bar() as progress:
        names, run_failures = record(
            fmu,
            find_scenes(scenes),
            folder,
            progress,
            must_apply=bool(scenes),
            replace=replace,
            time_limit=time_limit,
        )
    print_text(f"recorded {number_of(len(names), 'scene')} in {one_line(str(folder))}")
    print_run_failures(str(fmu), run_failures)
    return 2 if run_failures else 0


@baseline_command.command("check", short_help="Compare an FMU with the recorded results.")
@fmu_argument
@dir_option
@scenes_option("all recorded")
@click.option(
    "--tolerance",
    type=click.FloatRange(min=0.0),
    default=TOLERANCE,
    help="Largest change that passes, relative to a number, a signal's peak or, for event times, "
    "the drive period.",
)
@click.option("--details", is_flag=True, help="Show unchanged results too.")
@limited
@report_options("Slider-resonator baseline")
def check_command(
    fmu: Path,
    folder: Path,
    scenes: tuple[str, ...],
    tolerance: float,
    details: bool,
    time_limit: float,
    reports: Reports,
) -> int:
    """Compare an FMU with the recorded results: what has changed, by how much and where.

    Changed results are kept, ignored by git, for accept. Exit code: 0 when nothing has changed, 1
    when something has, 2 when something could not run.

    \b
    Examples:
      slider-resonator baseline check my.fmu --dir baseline
      slider-resonator baseline check my.fmu --dir baseline --scene table_1 --tolerance 1e-6
      slider-resonator baseline check my.fmu --dir baseline --junit report.xml --html report.html
    """
    reports.spare({"the FMU": fmu})
    try:
        found = find_scenes(scenes) if scenes else []
        with progress_bar() as progress:
            result = check(fmu, found, folder, progress, tolerance=tolerance, time_limit=time_limit)
    except HarnessError as error:
        reports.write([], str(error))
        raise
    reports.print([result], details=details, only_failed=not details)
    reports.write([result])
    return result.exit_code


@baseline_command.command("accept")
@fmu_argument
@dir_option
@click.option(
    "--scene",
    "scenes",
    multiple=True,
    metavar="NAME",
    help="A changed scene. Repeatable.  [default: all changed ones]",
)
def accept_command(fmu: Path, folder: Path, scenes: tuple[str, ...]) -> None:
    """Accept the changes that the last check of this FMU has found.

    Nothing runs again. Exit code: 0, or 2 for an unchanged scene or an FMU other than the checked
    one.

    \b
    Examples:
      slider-resonator baseline accept my.fmu --dir baseline
      slider-resonator baseline accept my.fmu --dir baseline --scene table_1 --scene lift_off
    """
    names = accept(fmu, folder, scenes)
    print_text(f"accepted {', '.join(names) or 'nothing: nothing has changed'}")
