"""All mutants of a Python FMU, and samples of them."""

from collections.abc import Sequence
from random import Random
from typing import TypeVar

from slider_resonator.errors import HarnessError, unknown_name
from studies.mutants.archive import DESCRIPTION, PythonFmu
from studies.mutants.enumerate_source import source_mutants
from studies.mutants.mutant import Mutant
from studies.mutants.units import unit_mutants

Change = TypeVar("Change")


def fmu_mutants(fmu: PythonFmu, files: Sequence[str] = ()) -> list[Mutant]:
    """Return the mutants of all files, or of some, in the order of files and lines.

    The same FMU gives the same mutants in the same order. Raises HarnessError for an unknown file.
    """
    known = [*fmu.modules, DESCRIPTION]
    for file in files:
        if file not in known:
            raise HarnessError(unknown_name("module", file, known))
    found = []
    for file in known:
        if files and file not in files:
            continue
        if file == DESCRIPTION:
            found += unit_mutants(fmu.text(DESCRIPTION))
            continue
        found += source_mutants(file, fmu.path_of(file), fmu.modules[file])
    return found


def sample(mutants: Sequence[Change], count: int | None, seed: int) -> list[Change]:
    """Return `count` of the mutants, or all, in their order, the same ones for the same seed."""
    if count is None or count >= len(mutants):
        return list(mutants)
    chosen = Random(seed).sample(range(len(mutants)), count)
    return [mutants[index] for index in sorted(chosen)]
