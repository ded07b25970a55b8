"""`fit`: parameters of a device from measurements."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from slider_resonator.commands import options
from slider_resonator.device.interface import VARIABLES
from slider_resonator.fitting.measurements import datasheet
from slider_resonator.fitting.reading import read_measurements
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import print_result
from slider_resonator.output.files import distinct, make_folder
from slider_resonator.output.progress import progress_bar
from slider_resonator.output.readable import one_line

_VELOCITY = options.Parsed("m/s", VARIABLES["steady_velocity"].read)
_FORCE = options.Parsed("N", VARIABLES["blocking_force"].read)
_LOADED = options.Parsed(
    "LOAD=VELOCITY",
    lambda load, velocity: (VARIABLES["load"].read(load), _VELOCITY.read(velocity)),
    "(.*?)=(.*)",
    "'50 mN=30 mm/s'",
)
_BOUNDS = options.Parsed(
    "NAME=LOW:HIGH",
    lambda name, low, high: (name, (low, high)),
    r"\s*(\w+)=([^:]+):([^:]+)",
    "damping_ratio=0.001:0.2",
)


@click.command("fit", cls=options.SettingsCommand)
@click.argument("data", type=options.DATA_FILE, nargs=-1)
@click.option(
    "--free",
    metavar="NAME,...",
    required=True,
    help="Parameters to estimate. Repeatable.",
    multiple=True,
)
@click.option(
    "--bounds",
    type=_BOUNDS,
    multiple=True,
    callback=options.each_once,
    help="Bounds of one. Repeatable.",
)
@click.option("--velocity", type=_VELOCITY, help="Velocity without load.")
@click.option("--blocking", type=_FORCE, help="Load that stops the slider.")
@click.option(
    "--velocity-at",
    "loaded",
    type=_LOADED,
    multiple=True,
    help="Velocity under a load, as '50 mN=30 mm/s'. Repeatable.",
)
@click.option(
    "--starts",
    type=click.IntRange(min=1),
    default=5,
    help="Starts of the search: the device, and others beside it.",
)
@options.out_folder_option("device.toml, fit.png, residuals.csv and fit.html", required=False)
@options.device_options
@options.fmu_option
@options.jobs_option
@options.time_limit_option(TIME_LIMIT, "For each start and each end of an interval.")
@options.json_option
def fit_command(
    data: tuple[Path, ...],
    free: Sequence[str],
    bounds: dict[str, Any],
    velocity: float | None,
    blocking: float | None,
    loaded: Sequence[tuple[float, float]],
    starts: int,
    out: Path | None,
    given: options.Given,
    fmu: Path,
    jobs: int,
    time_limit: float,
    as_json: bool,
) -> int:
    """Estimate parameters of a device from measurements, with 95 % intervals.

    DATA are CSV files. A table has a row for each steady measurement: columns that say what was set
    (phase, load, frequency, amplitude, any parameter) and what was measured (steady_velocity,
    blocking_force, or either). A run has a column time, those of inputs, and those of outputs that
    were measured. A heading may have a unit in brackets, such as "phase [deg]"; a column
    steady_velocity_std has standard deviations. Numbers of a datasheet are options. What is not
    free keeps the value of the device. What the data leave open is named, and gets no digits.

    Exit code: 0 when all free parameters are determined, 1 when some are left open or the numbers
    of a datasheet cannot be met, 2 when the fit could not run.

    \b
    Examples:
      slider-resonator fit measured.csv --device mine.toml --free friction_coefficient,damping_ratio
      slider-resonator fit --velocity "47 mm/s" --blocking "0.2 N" --free slider_mass,damping_ratio
      slider-resonator fit measured.csv --free friction_coefficient --out fitted
    """
    # Imported here: fitting and drawing take longer to load than other commands to run.
    from slider_resonator.fitting.fit import fit, isolated
    from slider_resonator.fitting.report import FILES, parameter_table, write_report

    measurements = sum(
        (read_measurements(path) for path in data), datasheet(velocity, blocking, loaded)
    )
    if not len(measurements.measured):
        raise click.UsageError("no measurements: must be CSV files, --velocity or --blocking")
    measurements.refuse_known(given.settings)
    if out is not None:
        make_folder(out)
        sources = {f"the data {path.name}": path for path in data} | given.sources
        distinct({f"{name} of --out": out / name for name in FILES}, sources)
        if (out / "device.toml").exists() and not (out / "fit.html").exists():
            raise click.UsageError(
                f"--out {out}: has a device.toml that no fit has written; must be another folder"
            )
    provenance = provenance_of(fmu)
    with progress_bar() as progress, isolated(fmu, jobs, time_limit, progress) as run:
        found = fit(
            measurements,
            [name.strip() for names in free for name in names.split(",") if name.strip()],
            given.values,
            run,
            bounds=bounds,
            starts=starts,
        )
    title = f"Fit to {', '.join(one.name for one in data) or 'a datasheet'}"
    written = [] if out is None else write_report(found, out, title, provenance)
    document = {key: value for key, value in vars(found).items() if key != "measurements"}
    document["written"] = written
    lines = found.sentences()
    if written:
        lines.append(f"written: {one_line(', '.join(map(str, written)))}")
    table = parameter_table(found)
    print_result(document, table, lines, as_json=as_json, provenance=provenance)
    return 1 if found.open_directions or found.unmet else 0
