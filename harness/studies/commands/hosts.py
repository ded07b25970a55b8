"""`hosts`: run table 1 in other simulators and write the table of docs/hosts.md."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import click

from slider_resonator.commands.options import fmu_argument, json_option, target, time_limit_option
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.finished import COMMANDS_LOOK_IN, FMUS, finished_path
from slider_resonator.fmu.opening import check_unpacked_size
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output import markdown
from slider_resonator.output.console import noting_on_interrupt, print_result, print_text
from slider_resonator.output.files import write_marked
from slider_resonator.output.progress import counted, progress_bar
from slider_resonator.output.table import Table, texts, verdict
from studies.hosts.hosts import OWN_ENVIRONMENTS, Host, hosts
from studies.hosts.runs import ALLOWED, TIME_LIMIT, HostResult, run_host
from studies.hosts.table import BEGIN, END, host_table

NAMES = [host.name for host in hosts()]


@click.command("hosts")
@fmu_argument
@click.option(
    "--python-fmu",
    type=click.Path(path_type=Path, exists=True, dir_okay=False),
    help="FMU that needs Python in the process, for the hosts that provide it.  [default: "
    "SliderResonatorPy.fmu in dist]",
)
@click.option(
    "--fmi3-fmu",
    type=click.Path(path_type=Path, exists=True, dir_okay=False),
    help="FMU of FMI 3.0, for the hosts that load it; it is compared with FMU.  [default: "
    "SliderResonator3.fmu in dist]",
)
@click.option(
    "--host",
    "chosen",
    type=click.Choice(NAMES),
    metavar="HOST",
    multiple=True,
    help=f"Run only this host. Repeatable. One of {', '.join(NAMES)}.",
)
@click.option(
    "--own-environments",
    type=click.Path(path_type=Path, file_okay=False),
    default=OWN_ENVIRONMENTS,
    help="Folder with the environments of cofmupy and of the newest fmpy, as `make hosts` "
    "creates them.",
)
@click.option(
    "--out",
    type=target((".md",)),
    help="Markdown file for the table, which goes between the lines <!-- hosts --> and "
    "<!-- end of hosts --> if the file has them.",
)
@time_limit_option(TIME_LIMIT, "For all cases of an FMU in a host.")
@json_option
@click.pass_context
def hosts_command(
    context: click.Context,
    fmu: Path,
    python_fmu: Path | None,
    fmi3_fmu: Path | None,
    chosen: Sequence[str],
    own_environments: Path,
    out: Path | None,
    time_limit: float,
    as_json: bool,
) -> None:
    """Run table 1 in other simulators and compare with fmpy.

    FMU is one that runs without Python. Each fidelity runs with each friction law for 40 steps of
    1 ms in which all inputs change. All outputs are compared after every step; deviations are
    relative to each signal's peak. Exit code: 0 when all agree, 1 when one does not, 2 when the
    FMUs do not run in fmpy. Hosts that are not installed are listed and left out (`make hosts`
    installs them); one that --host names, or any with --out, ends the command with 2.

    \b
    Examples:
      python -m harness hosts
      python -m harness hosts my.fmu --host "C driver" --json
      python -m harness hosts --out docs/hosts.md
    """
    python = python_fmu or finished_path(FMUS["python"], COMMANDS_LOOK_IN)
    native_3 = fmi3_fmu or finished_path(FMUS["fmi3"], COMMANDS_LOOK_IN)
    everyone = hosts(own_environments)
    selected = [host for host in everyone if host.name in (chosen or NAMES)]
    missing = _missing([everyone[0], *selected])
    if everyone[0] in missing or (missing and (chosen or out)):
        raise HarnessError("; ".join(dict.fromkeys(missing.values())))
    for one in (fmu, python):
        check_unpacked_size(one)
    selected = [host for host in selected if host not in missing]
    provenance = provenance_of(fmu, python)
    results: list[HostResult] = []
    with noting_on_interrupt(), progress_bar() as progress:
        for index, host in enumerate(selected):
            progress(counted(host.name, index, len(selected)), index / len(selected))
            results += run_host(host, everyone[0], fmu, python, native_3, time_limit)
    for host, reason in missing.items():
        print_text(f"not run: {host.name}: {reason}", err=True)
    if out is not None:
        write_marked(out, markdown.rendered(host_table(results)), BEGIN, END)
    entries = [_entry(result) for result in results]
    print_result(entries, *_shown(results), as_json=as_json, provenance=provenance)
    context.exit(0 if all(result.passed for result in results) else 1)


def _missing(selected: Sequence[Host]) -> dict[Host, str]:
    """Return the hosts that are not installed, with what is missing."""
    missing = {}
    for host in selected:
        try:
            host.version()
        except HarnessError as error:
            missing[host] = str(error)
    return missing


def _entry(result: HostResult) -> dict[str, object]:
    cases = [
        {"friction_law": case.friction_law, "fidelity": case.fidelity, "passed": found.passed}
        | {"deviation": found.deviation, "allowed": ALLOWED, "error": found.error}
        for case, found in result.comparisons.items()
    ]
    entry = {"host": result.host, "version": result.version, "fmu": result.fmu}
    return entry | {"passed": result.passed, "cases": cases}


def _shown(results: Sequence[HostResult]) -> Iterator[Table | list[str]]:
    """Yield the table, and what went wrong in a line each."""
    table = host_table(results)
    rows = [(*row, verdict(result.passed)) for row, result in zip(table.rows, results, strict=True)]
    yield Table([*table.columns, *texts("")], rows)
    for result in results:
        for case, comparison in result.comparisons.items():
            if comparison.error:
                where = f"{result.host}, {result.fmu} FMU, {case.title}"
                yield [f"{where}: {comparison.error}"]
