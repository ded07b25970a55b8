"""Make faulty variants of an FMU and count how many are rejected."""

import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from slider_resonator.output.files import temporary_folder
from studies.mutants.archive import PythonFmu
from studies.mutants.bench import Judging
from studies.mutants.changes import Change
from studies.mutants.judging import judge_variants
from studies.mutants.mutant import Mutant
from studies.mutants.verdict import EQUIVALENT, SURVIVED, MutationRun
from studies.mutants.workshop import Workshop, read_native_sources


def run_mutants(
    path: Path, fmu: PythonFmu, mutants: Sequence[Mutant], made: int, judging: Judging
) -> MutationRun[Mutant]:
    """Judge mutants, a sample of `made` ones, of the FMU at `path`; errors as `judge_variants`."""
    began = time.perf_counter()

    def write(mutant: Mutant, out: Path) -> None:
        fmu.write(out, {mutant.path: mutant.new})

    verdicts = judge_variants(path, mutants, write, judging)
    return MutationRun(str(path), made, verdicts, time.perf_counter() - began)


def run_changes(path: Path, changes: Sequence[Change], judging: Judging) -> MutationRun[Change]:
    """Judge changes of the C sources in the FMU at `path`. A fault without any effect survives.

    Raises HarnessError when a change does not fit the sources or there is no compiler, FmuError for
    an FMU without sources, otherwise as `judge_variants`.
    """
    began = time.perf_counter()
    sources = read_native_sources(path)
    for change in changes:
        change.applied(sources.files)
    with temporary_folder() as folder:
        verdicts = judge_variants(path, changes, Workshop(sources, folder).write, judging)
    faults = tuple(
        replace(verdict, status=SURVIVED) if verdict.status == EQUIVALENT else verdict
        for verdict in verdicts
        if not verdict.variant.harmless
    )
    harmless = tuple(verdict for verdict in verdicts if verdict.variant.harmless)
    wall_time = time.perf_counter() - began
    return MutationRun(str(path), len(faults), faults, wall_time, harmless)
