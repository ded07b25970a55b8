"""`closed-loop`: run the slider in a system where a controller holds its velocity."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import click
import numpy as np

from slider_resonator.commands.options import json_option, out_folder_option, time_limit_option
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.finished import COMMANDS_LOOK_IN, finished_path
from slider_resonator.fmu.opening import check_unpacked_size
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import noting_on_interrupt, print_result
from slider_resonator.output.files import make_folder, write_csv
from slider_resonator.output.progress import counted, part_of, progress_bar
from slider_resonator.output.readable import one_line
from slider_resonator.output.table import Row, Table, numbers, texts, verdict
from studies.closed_loop.duty import Duty
from studies.closed_loop.judge import Agreement, IntervalResult, judge_agreement, judge_interval
from studies.closed_loop.loop import HOSTS, LoopRecord, run_loop
from studies.closed_loop.picture import draw_loop
from studies.closed_loop.prediction import predicted_errors
from studies.hosts.runs import TIME_LIMIT

PACKAGE = "ClosedLoop.ssp"
NAMES = [host.name for host in HOSTS]
HOLD_COLUMNS = (
    *texts("host"),
    *numbers("fidelity", "at [s]", "load [mN]", "largest", "settled after [s]", "then within"),
    *texts(""),
)
AGREEMENT_COLUMNS = (
    *texts("host"),
    *numbers("at [s]", "load [mN]", "difference [um/s]", "largest at [s]", "predicted [um/s]"),
    *texts(""),
)


@click.command("closed-loop")
@click.argument("package", type=click.Path(path_type=Path), required=False)
@out_folder_option("closed_loop.png and closed_loop.csv")
@click.option(
    "--host",
    "chosen",
    type=click.Choice(NAMES),
    multiple=True,
    help="Host to run it in. Repeatable.  [default: fmpy]",
)
@time_limit_option(TIME_LIMIT, "For each run in a host, and for each prediction.")
@json_option
@click.pass_context
def closed_loop_command(
    context: click.Context,
    package: Path | None,
    out: Path,
    chosen: Sequence[str],
    time_limit: float,
    as_json: bool,
) -> None:
    """Hold the slider's velocity under a changing load, at fidelity 0 and at fidelity 2.

    PACKAGE is an SSP package; the default is ClosedLoop.ssp in dist or of the installation. A
    controller FMU moves the phase; the load steps four times. From 0.6 s after each step on, the
    velocity must stay within 2 %. From the first step on both fidelities must agree within 1 um/s,
    or the error that `choose` predicts for averaged motion with the controller's inputs. Exit code:
    0 when both hold, 1 when one does not, 2 when the package could not run.

    \b
    Examples:
      python -m harness closed-loop --out closed_loop
      python -m harness closed-loop --out closed_loop --host fmpy --host libcosimpy --json
    """
    package, duty = package or finished_path(PACKAGE, COMMANDS_LOOK_IN), Duty()
    if not package.is_file():
        raise HarnessError(f"{package}: no such file")
    check_unpacked_size(package)
    make_folder(out)
    provenance = provenance_of(package)
    held: list[IntervalResult] = []
    agreements: list[Agreement] = []
    records: list[LoopRecord] = []
    hosts = [host for host in HOSTS if host.name in (chosen or NAMES[:1])]
    with noting_on_interrupt(), progress_bar() as progress:
        for index, host in enumerate(hosts):
            part = part_of(progress, index, len(hosts))
            share = partial(part, counted(host.name, index, len(hosts)))
            share(0.0)
            design, proof = run_loop(package, host, duty, time_limit)
            records += [design, proof]
            held += [judge_interval(r, duty, i) for r in (design, proof) for i in duty.intervals]
            predicted = predicted_errors(package, design, duty, share, time_limit)
            agreements += judge_agreement(design, proof, duty, predicted)
    title = f"Velocity held by moving the phase: {package.name} in {hosts[0].name}"
    first = agreements[: len(duty.load_steps)]
    draw_loop(records[0], records[1], duty, first, out / "closed_loop.png", title)
    _write_csv(out / "closed_loop.csv", records, duty)
    passed = all(h.passed for h in held) and all(a.passed for a in agreements)
    facts = {"passed": passed, "package": str(package), "duty": duty}
    found = {**facts, "held": held, "agreements": agreements}
    written = [f"written  {one_line(f'{out}/closed_loop.png, {out}/closed_loop.csv')}"]
    tables = (_hold_table(held), _agreement_table(agreements))
    print_result(found, *tables, written, as_json=as_json, provenance=provenance)
    context.exit(0 if passed else 1)


def _write_csv(path: Path, records: Sequence[LoopRecord], duty: Duty) -> None:
    """Write the end of each step with the inputs held over it and the outputs."""
    header = ["time [s]", "velocity_reference [m/s]"]
    columns = [records[0].times, np.full(len(duty.times), duty.reference)]
    for record in records:
        run = f"{record.host} fidelity {record.fidelity}"
        header += [f"{run} {name}" for name in ("load [N]", "mean_velocity [m/s]", "phase [rad]")]
        columns += [record.load, record.velocity, record.phase]
    write_csv(path, header, zip(*(column.tolist() for column in columns), strict=True))


def _hold_table(held: Sequence[IntervalResult]) -> Table:
    holds: list[Row] = [
        (
            *(entry.host, str(entry.fidelity), f"{entry.start:g}", f"{1e3 * entry.load:g}"),
            *(f"{entry.largest:.1%}", "never" if entry.settled is None else f"{entry.settled:.2f}"),
            *(f"{entry.after_settling:.2%}", verdict(entry.passed)),
        )
        for entry in held
    ]
    return Table(HOLD_COLUMNS, holds)


def _agreement_table(agreements: Sequence[Agreement]) -> Table:
    differences: list[Row] = [
        (
            *(entry.host, f"{entry.start:g}", f"{1e3 * entry.load:g}"),
            *(f"{1e6 * entry.difference:.2g}", f"{entry.time:.2f}", _predicted(entry)),
            verdict(entry.passed),
        )
        for entry in agreements
    ]
    return Table(AGREEMENT_COLUMNS, differences)


def _predicted(agreement: Agreement) -> str:
    if agreement.predicted is None:
        return "fidelity 0 rejected"
    return f"{1e6 * agreement.predicted:.2g}"
