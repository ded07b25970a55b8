"""`stress`, once `extremes` and `campaign`: run FMUs at extremes and with random devices."""

import re
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from functools import partial
from pathlib import Path

import click

from slider_resonator.commands import options
from slider_resonator.commands.results import print_result
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.tasks import available_cores
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import noting_on_interrupt
from slider_resonator.output.progress import part_of
from slider_resonator.output.progress_bar import progress_bar
from slider_resonator.output.readable import number_of, one_line
from slider_resonator.output.targets import distinct, make_folder
from slider_resonator.stressing.axes import axis_cases, device_cases
from slider_resonator.stressing.case import DEVICE, RANDOM, Case
from slider_resonator.stressing.listing import (
    Files,
    as_plain,
    in_folder,
    values_of,
    write_files,
)
from slider_resonator.stressing.random_cases import random_case
from slider_resonator.stressing.run import TIME_LIMIT, StressResult, applicable, run_cases

CASES = 1000
"""Random devices of a campaign."""
_OWN = re.compile(rf"{DEVICE} (.+?): ")
_DRAWN = re.compile(rf"{RANDOM}: seed (\d+), case (\d+)(?:: .*)?")


long_option = click.option(
    "--long",
    is_flag=True,
    help="Lengthen resolved runs from 1e5 to 1e8 drive periods, with LuGre friction from 1e3 to "
    "1e6: minutes each in the native FMU, so give slower ones a --time-limit. Averaged motion "
    "always has 1e8.",
)


def _random_option(name: str, default: int, text: str) -> Callable[[options.FC], options.FC]:
    """Return an option of random devices, a whole number."""
    return click.option(
        f"--{name}",
        type=click.IntRange(min=0),
        default=default,
        show_default=True,
        envvar=f"CAMPAIGN_{name.upper()}",
        show_envvar=True,
        help=text,
    )


first_option = _random_option("first", 0, "Number of the first random device.")
seed_option = _random_option("seed", 1, "Seed of the random devices: the same cases everywhere.")


@click.command("stress")
@options.fmus_argument
@click.option(
    "--random",
    "count",
    type=click.IntRange(min=1),
    help="Run this number of random devices instead of the axes. Each takes about half a second.",
)
@first_option
@seed_option
@long_option
@options.device_option
@click.option("--case", "name", metavar="NAME", help="Run the case of this name alone.")
@options.time_limit_option(TIME_LIMIT, "For each case; one that hangs fails.")
@options.jobs_option
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for stress.json and index.html.",
)
@options.json_option
def stress_command(
    fmus: tuple[Path, ...],
    count: int | None,
    first: int,
    seed: int,
    long: bool,
    device: str | None,
    name: str | None,
    time_limit: float,
    jobs: int | None,
    out: Path | None,
    as_json: bool,
) -> int:
    """Run FMUs at the extremes of everything, or with random devices, and judge them by physics.

    A case on an axis takes a parameter, an input or the steps to an extreme. It passes the bounds
    that follow from the equations, agrees with other steps and, where one is in reach, with a
    reference, or is refused by name. With --random devices lie over decades; inputs, tunable
    parameters and step sizes change in the run, and each is compared with its reference. With
    --device the cases are those of a device of yours: several inputs and steps, by all models. A
    hang or a crash fails its case. Without FMUS: those in dist. Exit code: 0 when no case fails, 1
    when one does, 2 when an FMU could not run or no case applies to it. What has run is written
    when the command is interrupted.

    \b
    Examples:
      slider-resonator stress --out stress
      slider-resonator stress my.fmu --random 10000 --out stress --json
      slider-resonator stress --device mine.toml --out stress
      slider-resonator stress my.fmu --case "r_m: 1e-12: Coulomb, fidelity 1"
    """
    given = {"--random": count, "--device": device, "--case": name}
    several = [f"{option} {value}" for option, value in given.items() if value is not None]
    if len(several) > 1:
        raise click.UsageError(f"{' and '.join(several)}: must be only one")
    if name is not None:
        cases = [case_named(name, "--case")]
    elif device is not None:
        cases = device_cases(device, options.device_file(device).values)
    elif count is not None:
        cases = [random_case(seed, number) for number in range(first, first + count)]
    else:
        cases = axis_cases(long=long)
    files = Files() if out is None else in_folder(out, "stress")
    return stress(fmus, cases, files, time_limit, jobs, as_json=as_json)


@click.command("extremes")
@options.fmus_argument
@options.out_folder_option("extremes.json and index.html")
@options.time_limit_option(TIME_LIMIT, "For each case; one that hangs fails.", "--limit")
@long_option
@click.option("--cell", "name", metavar="NAME", help="Run only the case of this name.")
@options.json_option
def extremes_command(
    fmus: tuple[Path, ...],
    out: Path,
    time_limit: float,
    long: bool,
    name: str | None,
    as_json: bool,
) -> int:
    """Run `stress` on its axes.

    \b
    Examples:
      slider-resonator extremes --out extremes
      slider-resonator extremes my.fmu --out one --cell "r_m: 1e-12: Coulomb, fidelity 1"
    """
    cases = axis_cases(long=long) if name is None else [case_named(name, "--cell")]
    return stress(fmus, cases, in_folder(out, "extremes"), time_limit, as_json=as_json)


@click.command("campaign")
@options.fmus_argument
@click.option(
    "--cases",
    type=click.IntRange(min=1),
    default=CASES,
    show_default=True,
    help="Number of cases. Each takes about half a second.",
)
@first_option
@seed_option
@click.option(
    "--case",
    "number",
    type=click.IntRange(min=0),
    help="Run only the case of this number, and print its values.",
)
@options.time_limit_option(60.0, "For each case; one that hangs fails.")
@click.option("--out", type=options.target((".json",)), help="Write the result as JSON, too.")
@click.option("--html", type=options.target((".html",)), help="One page with plots to point at.")
@options.json_option
def campaign_command(
    fmus: tuple[Path, ...],
    cases: int,
    first: int,
    seed: int,
    number: int | None,
    time_limit: float,
    out: Path | None,
    html: Path | None,
    as_json: bool,
) -> int:
    """Run `stress` with random devices.

    \b
    Examples:
      slider-resonator campaign --cases 10000 --out campaign.json --html campaign.html
      slider-resonator campaign my.fmu --seed 1 --case 44
    """
    numbers = range(first, first + cases) if number is None else (number,)
    drawn = [random_case(seed, one) for one in numbers]
    return stress(fmus, drawn, Files(out, html), time_limit, as_json=as_json)


def case_named(name: str, option: str) -> Case:
    """Return the case of a name, on an axis or drawn; HarnessError when there is none."""
    drawn = _DRAWN.fullmatch(name)
    if drawn:
        return random_case(int(drawn[1]), int(drawn[2]))
    own = _OWN.match(name)
    found = (
        device_cases(own[1], options.device_file(own[1]).values) if own else axis_cases(long=True)
    )
    cases = {case.name: case for case in found}
    if name not in cases:
        near = get_close_matches(name, cases, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise HarnessError(
            f"{option} {name!r} refused: must be AXIS: VALUE: MODEL of a case, as in the result"
            f"{hint}"
        )
    return cases[name]


def stress(
    fmus: Sequence[Path],
    cases: Sequence[Case],
    files: Files,
    time_limit: float,
    jobs: int | None = None,
    *,
    as_json: bool,
) -> int:
    """Run the cases, print and write the result, and return the exit code."""
    chosen = fmus or options.default_fmus()
    distinct(
        {"--out": files.json, "--html": files.page}, {f"the FMU {path}": path for path in chosen}
    )
    for path in chosen:
        applicable(path, cases)  # before any of them runs: it takes minutes
    if files.folder is not None:
        make_folder(files.folder)
    provenance = provenance_of(*chosen)
    results: list[StressResult] = []

    def keep(result: StressResult) -> None:
        results.append(result)
        write_files(results, files, provenance)

    with noting_on_interrupt(partial(_kept, results, files)), progress_bar() as progress:
        for index, fmu in enumerate(chosen):
            part = part_of(progress, index, len(chosen))
            workers = jobs or available_cores()
            keep(run_cases(fmu, cases, part, time_limit, jobs=workers, keep=keep))
    lines = [line for result in results for line in result.sentences()]
    lines += [values_of(case) for case in cases if len(cases) == 1]
    lines += [f"written {one_line(name)}" for name in files.names]
    print_result(as_plain(results), "\n".join(lines), as_json=as_json, provenance=provenance)
    return 0 if all(result.passed for result in results) else 1


def _kept(results: Sequence[StressResult], files: Files) -> str:
    if not results or not files.names:
        return "nothing is kept; --out keeps what is finished"
    ran = sum(len(result.verdicts) for result in results)
    places = " and ".join(files.names)
    return (
        f"the verdicts of {number_of(ran, 'case')} are kept in {places}; the same command runs "
        "all cases again"
    )
