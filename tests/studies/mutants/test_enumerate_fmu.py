from __future__ import annotations

from pathlib import Path

import pytest

from studies.mutants.archive import DESCRIPTION, PythonFmu, read_python_fmu
from studies.mutants.enumerate_fmu import fmu_mutants, sample
from studies.mutants.mutant import KINDS, Mutant


@pytest.fixture(scope="module")
def fmu(python_fmu: Path) -> PythonFmu:
    return read_python_fmu(python_fmu)


@pytest.fixture(scope="module")
def mutants(fmu: PythonFmu) -> list[Mutant]:
    return fmu_mutants(fmu)


def test_all_kinds_are_made_in_all_files_that_compute(
    fmu: PythonFmu, mutants: list[Mutant]
) -> None:
    assert {m.kind for m in mutants} == set(KINDS)
    assert {m.file for m in mutants} == {*fmu.modules, DESCRIPTION} - {
        "__init__.py",
        "refusal_texts.py",
    }


@pytest.mark.parametrize("every", [10, pytest.param(1, marks=pytest.mark.slow)])
def test_every_mutant_of_the_component_compiles(mutants: list[Mutant], every: int) -> None:
    for mutant in mutants[::every]:
        assert mutant.new != mutant.old
        if mutant.kind != "unit":
            compile(mutant.new, mutant.name, "exec")


def test_a_sample_keeps_the_order_and_is_drawn_by_its_seed(mutants: list[Mutant]) -> None:
    some = sample(mutants, 20, seed=3)
    assert some == sample(mutants, 20, seed=3)
    assert some != sample(mutants, 20, seed=4)
    places = [mutants.index(m) for m in some]
    assert places == sorted(set(places))
    assert sample(mutants, 10**6, seed=0) == mutants
