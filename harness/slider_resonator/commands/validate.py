"""`validate`: compare FMUs with the references, and write reports for terminals and CI servers."""

from pathlib import Path

import click

from slider_resonator.checks.own_experiments import validate_own
from slider_resonator.checks.validate import validate
from slider_resonator.checks.verdict import TITLE
from slider_resonator.commands import options
from slider_resonator.commands.reports import Reports, report_options
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.output.progress import progress_bar
from slider_resonator.scenes.scene_files import find_scenes


@click.command("validate")
@options.fmus_argument
@options.scenes_option("all built-in")
@click.option(
    "--own",
    is_flag=True,
    help="In place of scenes run the experiments that each FMU carries (FMI-LS-REF), and compare "
    "with the results beside them.",
)
@click.option(
    "--details",
    is_flag=True,
    help="Show every check of every scene, every point of a sweep, and why it is expected.",
)
@options.jobs_option
@options.time_limit_option(TIME_LIMIT, "For each scene, or point of a sweep, on each FMU.")
@report_options(TITLE)
def validate_command(
    fmus: tuple[Path, ...],
    scenes: tuple[str, ...],
    own: bool,
    details: bool,
    jobs: int,
    time_limit: float,
    reports: Reports,
) -> int:
    """Compare FMUs with the references, scene by scene.

    Without FMUS: those in dist, the native one first. Each FMU runs in processes of its own, one
    until it has been opened and then up to --jobs, while as many others compute the
    references, once for all FMUs. Exit code: 0 when every check passes,
    1 when one fails, 2 when something could not run: an FMU that is corrupt, lacks a variable or
    gives it another unit, has no binary for this platform, cannot be instantiated, refuses a scene,
    crashes or exceeds the time limit. The reports are written in each case, and a table is appended
    to the file that GITHUB_STEP_SUMMARY names.

    \b
    Examples:
      slider-resonator validate
      slider-resonator validate my.fmu --scene table_1 --details
      slider-resonator validate my.fmu --scene scenes/mine.toml --json > report.json
      slider-resonator validate my.fmu --scene my_scenes --junit report.xml --html report.html
      slider-resonator validate my.fmu --own
    """
    if own and scenes:
        raise click.UsageError(f"--own and --scene {scenes[0]}: must be one of them")
    sources = {f"the FMU {path}": path for path in fmus}
    sources |= {f"the scene {scene}": Path(scene) for scene in scenes}
    reports.spare(sources)
    try:
        found = [] if own else find_scenes(scenes)
        paths = fmus or options.default_fmus()
        with progress_bar() as progress:
            if own:
                validations = validate_own(paths, progress, time_limit=time_limit)
            else:
                validations = validate(paths, found, progress, time_limit=time_limit, jobs=jobs)
    except HarnessError as error:
        reports.write([], str(error))
        raise
    reports.print(validations, details=details)
    if not own and any(one.checks and one.run_failures for one in validations):
        options.note(["--scene limits the scenes to those that the FMU can run"])
    reports.write(validations)
    return max(validation.exit_code for validation in validations)
