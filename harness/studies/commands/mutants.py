"""`mutants`: make faulty FMUs and count how many `validate` rejects."""

from collections.abc import Callable
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any

import click

from slider_resonator.commands.options import (
    fmu_argument,
    jobs_option,
    json_option,
    scenes_option,
    target,
    time_limit_option,
)
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.fmu.finished import COMMANDS_LOOK_IN, FMUS, finished_path
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import noting_on_interrupt, output, print_result
from slider_resonator.output.progress import progress_bar
from slider_resonator.scenes.scene_files import find_scenes
from studies.mutants.archive import read_python_fmu
from studies.mutants.bench import TIME_LIMIT, Judging
from studies.mutants.changes import Change, hand_written_changes
from studies.mutants.enumerate_fmu import fmu_mutants, sample
from studies.mutants.listing import (
    as_plain,
    changes_as_plain,
    mutants_as_plain,
    print_run,
    print_variants,
)
from studies.mutants.mutant import KINDS
from studies.mutants.runs import run_changes, run_mutants
from studies.mutants.verdict import MutationRun

MIN_RATE = 0.9
"""Share of the mutants that make a result worse that must be rejected for a pass."""

MIN_NATIVE_RATE = 0.97
"""Share of the hand-written faults that must be rejected for a pass."""


@click.command("mutants")
@partial(fmu_argument, default="the one in dist for the kind of mutant", chosen=lambda given: given)
@click.option(
    "--native",
    is_flag=True,
    help="Hand-written faults of the C sources in the native FMU, and harmless variants.",
)
@click.option(
    "--list", "only_list", is_flag=True, help="List the mutants with diffs and run nothing."
)
@click.option(
    "--sample", "count", type=click.IntRange(min=1), help="Try a random sample of this size."
)
@click.option(
    "--seed",
    type=int,
    default=0,
    envvar="MUTANTS_SEED",
    show_envvar=True,
    help="Seed of the sample.",
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
    metavar="KIND",
    help=f"Only mutants of this kind. Repeatable. One of {', '.join(KINDS)}.",
)
@scenes_option("all built-in")
@jobs_option
@time_limit_option(
    TIME_LIMIT,
    "Time of a mutant in each scene, or point of a sweep; a mutant that exceeds it is rejected.",
)
@click.option(
    "--journal",
    type=target([]),
    help="Keep the verdicts in this file; a run that is stopped goes on from there.",
)
@json_option
@click.pass_context
def mutants_command(
    context: click.Context,
    fmu: Path | None,
    native: bool,
    only_list: bool,
    count: int | None,
    seed: int,
    files: tuple[str, ...],
    kinds: tuple[str, ...],
    scenes: tuple[str, ...],
    jobs: int,
    time_limit: float,
    journal: Path | None,
    as_json: bool,
) -> None:
    """Make faulty FMUs and count how many of them `validate` rejects.

    Each mutant is a copy of the Python FMU with one fault: a wrong operator, constant, sign,
    condition, statement or unit. It runs on the scenes in a process of its own, those first that
    rejected others of the same file, then the cheapest, until a check fails; a crash or a hang
    counts as rejected. What passes all is equivalent if no result is further off its reference than
    the original's by more than a hundredth of what its check allows; otherwise it survives. Without
    FMU: the Python one in dist.

    With --native a C compiler of this machine builds copies of the native FMU from its sources,
    each with one fault written by hand, or with a harmless change that must pass.

    Exit code: 0 when at least 90 % of the mutants that make a result worse are rejected, with
    --native 97 % of the faults and no harmless variant; 1 when fewer are, 2 when there is nothing
    to try or the unchanged FMU is rejected.

    \b
    Examples:
      python -m harness mutants --list --file coulomb.py
      python -m harness mutants --sample 200 --seed 1 --journal verdicts
      python -m harness mutants --kind sign --kind unit
      python -m harness mutants --file coulomb.py --json > mutants.json
      python -m harness mutants --native --file lugre.c
    """
    if native and kinds:
        raise click.UsageError("--native refused: must be without --kind")
    path = fmu or finished_path(FMUS["native" if native else "python"], COMMANDS_LOOK_IN)
    judge: Callable[[Judging], MutationRun[Any]]
    if native:
        changes = sample(_changes(files), count, seed)
        listed = {"changes": [as_plain(change) for change in changes]}
        judge, min_rate = partial(run_changes, path, changes), MIN_NATIVE_RATE
    else:
        original = read_python_fmu(path)
        made = [m for m in fmu_mutants(original, files) if not kinds or m.kind in kinds]
        if not made:
            asked = ", ".join([*files, *kinds])
            raise HarnessError(f"{path}: nothing to change: no mutant is of {asked}")
        mutants = sample(made, count, seed)
        listed = {"mutants": [as_plain(mutant) for mutant in mutants]}
        judge, min_rate = partial(run_mutants, path, original, mutants, len(made)), MIN_RATE
    if only_list:
        if as_json:
            print_result(listed, as_json=True)
        else:
            print_variants(output(), changes if native else mutants)
        return
    provenance = provenance_of(path)
    with noting_on_interrupt(lambda: _kept(journal)), progress_bar() as progress:
        judging = Judging(find_scenes(scenes), jobs, time_limit, journal, progress)
        run: MutationRun[Any] = judge(judging)
    if as_json:
        result = changes_as_plain(run) if native else mutants_as_plain(run)
        print_result(result, as_json=True, provenance=provenance)
    else:
        print_run(output(), run)
    enough = run.rate is None or run.rate >= min_rate
    context.exit(0 if enough and not run.false_alarms else 1)


def _kept(journal: Path | None) -> str:
    """Return what an interruption leaves, and how to go on."""
    if journal is None:
        return "nothing is kept; --journal FILE keeps the verdicts"
    return f"the verdicts so far are kept in {journal}; the same command goes on from there"


def _changes(files: tuple[str, ...]) -> list[Change]:
    """Return the changes of some files, with or without folder; HarnessError for an unknown one."""
    made = hand_written_changes()
    known = sorted({PurePosixPath(change.file).name for change in made})
    for file in files:
        if not any(PurePosixPath(change.file).match(file) for change in made):
            raise HarnessError(unknown_name("C file with changes", file, known))
    return [c for c in made if not files or any(PurePosixPath(c.file).match(f) for f in files)]
