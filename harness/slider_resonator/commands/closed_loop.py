"""`closed-loop`: the slider in a system, its velocity held by a controller."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import click
import numpy as np
from rich.table import Table

from slider_resonator.commands.options import REPOSITORY, json_option
from slider_resonator.errors import HarnessError
from slider_resonator.output.atomic import replacing
from slider_resonator.output.console import output, progress_bar
from slider_resonator.output.json_output import to_json
from slider_resonator.output.targets import make_folder
from slider_resonator.studies.closed_loop.duty import Duty
from slider_resonator.studies.closed_loop.judge import (
    Agreement,
    IntervalResult,
    judge_agreement,
    judge_intervals,
)
from slider_resonator.studies.closed_loop.loop import HOSTS, LoopRecord, run_loop
from slider_resonator.studies.closed_loop.picture import draw_loop
from slider_resonator.studies.closed_loop.prediction import predicted_errors

PACKAGE = Path("dist") / "ClosedLoop.ssp"
NAMES = [host.name for host in HOSTS]


@click.command("closed-loop")
@click.argument("package", type=click.Path(path_type=Path), required=False)
@click.option(
    "--out", type=click.Path(path_type=Path), required=True, help="Folder for picture and data."
)
@click.option(
    "--host",
    "chosen",
    type=click.Choice(NAMES),
    multiple=True,
    help="Host to run it in; may be given more than once.  [default: fmpy]",
)
@json_option
@click.pass_context
def closed_loop_command(
    context: click.Context,
    package: Path | None,
    out: Path,
    chosen: Sequence[str],
    as_json: bool,
) -> None:
    """Hold the slider's velocity under a changing load, at fidelity 0 and at fidelity 2.

    PACKAGE is an SSP package such as dist/ClosedLoop.ssp, the one that is run without it. A
    controller FMU moves the phase; the load steps four times. After each step, and 0.6 s to settle,
    the velocity has to stay within 2 %. From each step on, also while the loop answers, both
    fidelities have to agree within the error that `choose` predicts for averaged motion under what
    the controller did. Leaves with 0 when all of this holds, 1 when not, 2 when the
    package could not be run. Writes closed_loop.png and closed_loop.csv.

    \b
    Examples:
      python -m harness closed-loop --out closed_loop
      python -m harness closed-loop --out closed_loop --host fmpy --host libcosimpy --json
    """
    package, duty = package or _built(), Duty()
    if not package.is_file():
        raise HarnessError(f"{package}: no such file; build it with: python build_fmu.py")
    make_folder(out)
    held: list[IntervalResult] = []
    agreements: list[Agreement] = []
    records: list[LoopRecord] = []
    hosts = [host for host in HOSTS if host.name in (chosen or NAMES[:1])]
    with progress_bar() as progress:
        for index, host in enumerate(hosts):
            share = partial(_shared, progress, host.name, index, len(hosts))
            share(0.0)
            design, proof = run_loop(package, host, duty)
            records += [design, proof]
            held += [*judge_intervals(design, duty), *judge_intervals(proof, duty)]
            predicted = predicted_errors(package, design, duty, share)
            agreements += judge_agreement(design, proof, duty, predicted)
    title = f"Velocity held by moving the phase: {package.name} in {hosts[0].name}"
    first = agreements[: len(duty.load_steps)]
    draw_loop(records[0], records[1], duty, first, out / "closed_loop.png", title)
    _write_csv(out / "closed_loop.csv", records, duty)
    passed = all(h.passed for h in held) and all(a.passed for a in agreements)
    if as_json:
        facts = {"passed": passed, "package": str(package), "duty": duty}
        click.echo(to_json({**facts, "held": held, "agreements": agreements}))
    else:
        _show(held, agreements)
        click.echo(f"written  {out / 'closed_loop.png'}, {out / 'closed_loop.csv'}")
    context.exit(0 if passed else 1)


def _shared(
    progress: Callable[[str, float], None], label: str, index: int, count: int, share: float
) -> None:
    """Report the progress of one host among `count`."""
    progress(label, (index + share) / count)


def _built() -> Path:
    return PACKAGE if PACKAGE.is_file() else REPOSITORY / PACKAGE


def _write_csv(path: Path, records: Sequence[LoopRecord], duty: Duty) -> None:
    """Write the ends of the steps with what was held over them and what came out."""
    header = ["time [s]", "velocity_reference [m/s]"]
    columns = [records[0].times, np.full(len(duty.times), duty.reference)]
    for record in records:
        run = f"{record.host} fidelity {record.fidelity}"
        header += [f"{run} {name}" for name in ("load [N]", "mean_velocity [m/s]", "phase [rad]")]
        columns += [record.load, record.velocity, record.phase]
    with replacing(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(zip(*(column.tolist() for column in columns), strict=True))


def _show(held: Sequence[IntervalResult], agreements: Sequence[Agreement]) -> None:
    headings = ("host", "fidelity", "at", "load", "largest", "settled after", "then within", "")
    table = Table(*headings, box=None)
    for entry in held:
        table.add_row(
            entry.host,
            str(entry.fidelity),
            f"{entry.start:g} s",
            f"{1e3 * entry.load:g} mN",
            f"{entry.largest:.1%}",
            "never" if entry.settled is None else f"{entry.settled:.2f} s",
            f"{entry.after_settling:.2%}",
            _verdict(entry.passed),
        )
    console = output()
    console.print(table)
    console.print()
    table = Table("host", "at", "load", "fidelities differ by", "at", "predicted", "", box=None)
    for agreement in agreements:
        predicted = agreement.predicted
        table.add_row(
            agreement.host,
            f"{agreement.start:g} s",
            f"{1e3 * agreement.load:g} mN",
            f"{1e6 * agreement.difference:.1f} um/s",
            f"{agreement.time:.2f} s",
            "fidelity 0 rejected" if predicted is None else f"{1e6 * predicted:.1f} um/s",
            _verdict(agreement.passed),
        )
    console.print(table)


def _verdict(passed: bool) -> str:
    return "[green]pass[/green]" if passed else "[bold red]FAIL[/bold red]"
