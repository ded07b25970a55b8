"""`mutants`: make faulty FMUs and count how many `validate` rejects."""

from __future__ import annotations

from pathlib import Path

import click

from slider_resonator.commands.options import (
    Target,
    json_option,
    scenes_option,
    time_limit_option,
)
from slider_resonator.commands.results import print_json
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.finished import COMMANDS_LOOK_IN, FMUS, finished_path
from slider_resonator.output.console import output, progress_bar
from slider_resonator.output.targets import distinct
from slider_resonator.scenes.scene import files_of_scenes
from slider_resonator.studies.sweep.local import available_cores
from slider_resonator.trials.mutants.archive import read_python_fmu
from slider_resonator.trials.mutants.enumerate_fmu import fmu_mutants, sample
from slider_resonator.trials.mutants.listing import (
    mutant_as_plain,
    print_mutants,
    print_run,
    run_as_plain,
)
from slider_resonator.trials.mutants.mutant import KINDS
from slider_resonator.trials.mutants.mutation_run import PROBES, TIME_LIMIT, run_mutants
from slider_resonator.trials.mutants.page import write_mutants

MIN_RATE = 0.95
"""Share of the mutants that change a result that must be rejected for a pass."""


@click.command("mutants")
@click.argument("fmu", type=click.Path(path_type=Path), required=False)
@click.option(
    "--list", "only_list", is_flag=True, help="List the mutants with diffs and run nothing."
)
@click.option(
    "--sample", "count", type=click.IntRange(min=1), help="Try a random sample of this size."
)
@click.option(
    "--seed", type=int, default=0, show_default=True, help="Seed of the sample and the probes."
)
@click.option(
    "--file",
    "files",
    multiple=True,
    metavar="MODULE",
    help="Only mutants of this file, such as coulomb.py or modelDescription.xml. Repeatable.",
)
@click.option(
    "--kind",
    "kinds",
    multiple=True,
    type=click.Choice(list(KINDS)),
    help="Only mutants of this kind. Repeatable.",
)
@scenes_option("all built-in")
@click.option(
    "--probes",
    type=click.IntRange(min=0),
    default=PROBES,
    show_default=True,
    help="Random scenes that show whether a survivor changes a result.",
)
@click.option("--jobs", type=click.IntRange(min=1), help="Processes.  [default: one per core]")
@time_limit_option(
    TIME_LIMIT,
    "For a mutant and each scene, or point of a sweep; a mutant that exceeds it is rejected.",
)
@click.option(
    "--html", type=Target([".html"]), help="One page with all mutants that were not rejected."
)
@json_option
@click.pass_context
def mutants_command(
    context: click.Context,
    fmu: Path | None,
    only_list: bool,
    count: int | None,
    seed: int,
    files: tuple[str, ...],
    kinds: tuple[str, ...],
    scenes: tuple[str, ...],
    probes: int,
    jobs: int | None,
    time_limit: float,
    html: Path | None,
    as_json: bool,
) -> None:
    """Make faulty FMUs and count how many of them `validate` rejects.

    Each mutant is a copy of the Python FMU with one fault: a wrong operator, constant, sign,
    condition, statement, event, input or unit, or a parameter off by 1 %. It runs on the scenes
    that execute the changed statement, the cheapest first, in a process of its own, until a check
    fails; a crash or a hang counts as rejected. A survivor runs on random probes beside the
    original: it is equivalent if no result differs by more than the scenes allow. Without FMU: the
    Python one in dist.

    Exit code: 0 when at least 95 % of the mutants that change a result are rejected, 1 when fewer
    are, 2 when there is nothing to try or the unchanged FMU is rejected.

    \b
    Examples:
      slider-resonator mutants --list --file coulomb.py
      slider-resonator mutants --sample 200 --seed 1 --html mutants.html
      slider-resonator mutants --kind event --kind input --kind parameter --kind unit
      slider-resonator mutants --file coulomb.py --json > mutants.json
    """
    path = fmu or _python_fmu()
    distinct({"--html": html}, {f"the FMU {path}": path})
    original = read_python_fmu(path)
    made = [m for m in fmu_mutants(original, files) if not kinds or m.kind in kinds]
    chosen = made if count is None else sample(made, count, seed)
    if not chosen:
        asked = ", ".join([*files, *kinds])
        raise HarnessError(f"{path}: nothing to change: no mutant is of {asked}")
    if only_list:
        if as_json:
            print_json({"mutants": [mutant_as_plain(mutant) for mutant in chosen]})
        else:
            print_mutants(output(), chosen)
        return
    with progress_bar() as progress:
        run = run_mutants(
            path,
            original,
            chosen,
            files_of_scenes(scenes),
            made=len(made),
            jobs=jobs or available_cores(),
            probes=probes,
            seed=seed,
            time_limit=time_limit,
            progress=progress,
        )
    if html is not None:
        write_mutants(html, run)
    if as_json:
        print_json(run_as_plain(run))
    else:
        print_run(output(), run)
    context.exit(0 if run.rate is None or run.rate >= MIN_RATE else 1)


def _python_fmu() -> Path:
    """Return the built FMU with Python sources; FmuError where there is none."""
    return finished_path(FMUS["python"], COMMANDS_LOOK_IN)
