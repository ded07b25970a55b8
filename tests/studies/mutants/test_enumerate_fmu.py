from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import FmuError, HarnessError
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


def test_the_list_is_the_same_each_time_and_each_name_is_there_once(
    fmu: PythonFmu, mutants: list[Mutant]
) -> None:
    names = [m.name for m in mutants]
    assert names == [m.name for m in fmu_mutants(fmu)]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("every", [10, pytest.param(1, marks=pytest.mark.slow)])
def test_every_mutant_of_the_component_compiles(mutants: list[Mutant], every: int) -> None:
    for mutant in mutants[::every]:
        assert mutant.new != mutant.old
        if mutant.kind != "unit":
            compile(mutant.new, mutant.name, "exec")


def test_a_file_can_be_chosen_and_an_unknown_one_is_refused(fmu: PythonFmu) -> None:
    assert {m.file for m in fmu_mutants(fmu, ["budget.py"])} == {"budget.py"}
    with pytest.raises(HarnessError, match=r"did you mean 'budget\.py'"):
        fmu_mutants(fmu, ["budgt.py"])


def test_a_sample_keeps_the_order_and_is_drawn_by_its_seed(mutants: list[Mutant]) -> None:
    some = sample(mutants, 20, seed=3)
    assert some == sample(mutants, 20, seed=3)
    assert some != sample(mutants, 20, seed=4)
    places = [mutants.index(m) for m in some]
    assert places == sorted(set(places))
    assert sample(mutants, 10**6, seed=0) == mutants


def test_what_is_no_python_fmu_is_refused(fmu: PythonFmu, tmp_path: Path) -> None:
    files = {name: data for name, data in fmu.files.items() if not name.endswith(".py")}
    PythonFmu(files, "").write(tmp_path / "native.fmu", {})
    with pytest.raises(FmuError, match="has 0 Python packages"):
        read_python_fmu(tmp_path / "native.fmu")
    with pytest.raises(FmuError, match="no such file"):
        read_python_fmu(tmp_path / "no.fmu")


def test_a_mutant_is_packed_with_its_change_alone(
    fmu: PythonFmu, mutants: list[Mutant], tmp_path: Path
) -> None:
    mutant = mutants[0]
    fmu.write(tmp_path / "mutant.fmu", {mutant.path: mutant.new})
    packed = read_python_fmu(tmp_path / "mutant.fmu")
    different = [name for name in fmu.files if packed.files[name] != fmu.files[name]]
    assert different == [mutant.path]
    assert packed.text(mutant.path) == mutant.new
