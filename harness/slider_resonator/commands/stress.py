"""`stress`: run FMUs at extremes and with random devices."""

import re
from collections.abc import Callable
from pathlib import Path

import click
from click.core import ParameterSource

from slider_resonator.commands import options
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import noting_on_interrupt, print_result
from slider_resonator.output.files import make_folder
from slider_resonator.output.progress import part_of, progress_bar
from slider_resonator.output.readable import one_line
from slider_resonator.stressing.axes import axis_cases, device_cases
from slider_resonator.stressing.case import DEVICE, RANDOM, Case
from slider_resonator.stressing.random_cases import random_case
from slider_resonator.stressing.report import as_plain, values_of, write_results
from slider_resonator.stressing.run import TIME_LIMIT, StressResult, applicable, run_cases

_OWN = re.compile(rf"{DEVICE} (.+?): ")
_DRAWN = re.compile(rf"{RANDOM}: seed (\d+), case (\d+)(?:: .*)?")


def _random_option(name: str, default: int, text: str) -> Callable[[options.FC], options.FC]:
    """Return an option of random devices, a whole number."""
    return click.option(
        f"--{name}",
        type=click.IntRange(min=0),
        default=default,
        envvar=f"CAMPAIGN_{name.upper()}",
        show_envvar=True,
        help=text,
    )


@click.command("stress")
@options.fmus_argument
@click.option(
    "--random",
    "count",
    type=click.IntRange(min=1),
    help="Run this number of random devices instead of the axes. Each takes about half a second.",
)
@_random_option("first", 0, "Number of the first random device.")
@_random_option("seed", 1, "Seed of the random devices: the same cases everywhere.")
@click.option(
    "--long",
    is_flag=True,
    help="Lengthen resolved runs from 1e5 to 1e8 drive periods, with LuGre friction from 1e3 to "
    "1e6: minutes each in the native FMU, so give slower ones a --time-limit. Averaged motion "
    "always has 1e8.",
)
@options.device_option
@click.option("--case", "name", metavar="NAME", help="Run the case of this name alone.")
@options.time_limit_option(TIME_LIMIT, "For each case; one that hangs fails.")
@options.jobs_option
@options.out_folder_option("stress.json and index.html", required=False)
@options.json_option
@click.pass_context
def stress_command(
    context: click.Context,
    fmus: tuple[Path, ...],
    count: int | None,
    first: int,
    seed: int,
    long: bool,
    device: str | None,
    name: str | None,
    time_limit: float,
    jobs: int,
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
    several += ["--long"] if long else []
    if len(several) > 1:
        raise click.UsageError(f"{' and '.join(several)}: must be only one")
    # The environment may have them for other commands.
    stated = ParameterSource.COMMANDLINE
    drawn = [f"--{n}" for n in ("first", "seed") if context.get_parameter_source(n) is stated]
    if drawn and count is None:
        raise click.UsageError(f"{' and '.join(drawn)}: must be with --random")
    if name is not None:
        cases = [case_named(name)]
    elif device is not None:
        cases = device_cases(device, options.read_device(device).values)
    elif count is not None:
        cases = [random_case(seed, number) for number in range(first, first + count)]
    else:
        cases = axis_cases(long=long)
    chosen = fmus or options.default_fmus()
    apply = [applicable(path, cases) for path in chosen]  # before any runs: it takes minutes
    if out is not None:
        make_folder(out)
    provenance = provenance_of(*chosen)
    results: list[StressResult] = []

    def keep(result: StressResult) -> None:
        results.append(result)
        if out is not None:
            write_results(results, out, provenance)

    def kept() -> str:
        if not results or out is None:
            return "nothing is kept; --out keeps what is finished"
        return f"the verdicts of finished cases are kept in {out}"

    with noting_on_interrupt(kept), progress_bar() as progress:
        for index, (fmu, own) in enumerate(zip(chosen, apply, strict=True)):
            part = part_of(progress, index, len(chosen))
            keep(run_cases(fmu, cases, part, time_limit, jobs=jobs, chosen=own, keep=keep))
    lines = [line for result in results for line in result.sentences()]
    lines += [values_of(case) for case in cases if len(cases) == 1]
    lines += [] if out is None else [f"written {one_line(str(out))}"]
    print_result(as_plain(results), lines, as_json=as_json, provenance=provenance)
    return 0 if all(result.passed for result in results) else 1


def case_named(name: str) -> Case:
    """Return the case of a name, on an axis or drawn; HarnessError when there is none."""
    drawn = _DRAWN.fullmatch(name)
    if drawn:
        return random_case(int(drawn[1]), int(drawn[2]))
    own = _OWN.match(name)
    found = (
        device_cases(own[1], options.read_device(own[1]).values) if own else axis_cases(long=True)
    )
    cases = {case.name: case for case in found}
    if name not in cases:
        raise HarnessError(f"--case: {unknown_name('case', name, cases)}")
    return cases[name]
