from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import FmuError
from slider_resonator.scenes.scene_files import find_scene
from studies.mutants.archive import PythonFmu, read_python_fmu
from studies.mutants.enumerate_fmu import fmu_mutants
from studies.mutants.mutant import Mutant
from studies.mutants.mutation_run import run_mutants
from studies.mutants.staged_trials import StagedTrials
from studies.mutants.verdict import (
    EQUIVALENT,
    NOT_REACHED,
    REJECTED,
    SURVIVED,
    MutationRun,
)
from tests.harness import faulty_fmus

SCENES = ("changing_inputs", "input_jumps", "initial_state", "stick_slip", "lugre", "lift_off")

HARMFUL = (
    ("events.py", "each 50th stop or release is skipped"),
    ("moment.py", "reversals are not counted"),
    ("contact.py", "lift-off and touchdown happen at the next step only"),
    ("sliding.py", "a stick is never released"),
    ("component.py", "the normal phase jumps by 0.01 rad when phase changes"),
    ("component.py", "changed inputs act one communication step late"),
    ("component.py", "slider_mass acts 1 % too large"),
    ("component.py", "bristle_stiffness acts 1 % too large"),
    ("modelDescription.xml", "unit of load becomes 1/m"),
    ("device.py", "+ becomes -"),
)
HARMLESS = ("component.py", "tolerance acts 1 % too large")


@pytest.fixture(scope="module")
def fmu(python_fmu: Path) -> PythonFmu:
    return read_python_fmu(python_fmu)


def chosen(fmu: PythonFmu, keys: list[tuple[str, str]]) -> list[Mutant]:
    files = sorted({file for file, _ in keys})
    made = {(m.file, m.change): m for m in fmu_mutants(fmu, files)}
    return [made[key] for key in keys]


@pytest.mark.slow
def test_the_original_passes_and_known_faults_are_rejected(
    fmu: PythonFmu, python_fmu: Path
) -> None:
    mutants = chosen(fmu, [*HARMFUL, HARMLESS])
    scenes = [find_scene(scene) for scene in SCENES]
    run = run_mutants(python_fmu, fmu, mutants, scenes, made=99, jobs=2, probes=6)
    statuses = {verdict.mutant.name: verdict.status for verdict in run.verdicts}
    assert statuses == {
        m.name: EQUIVALENT if m.change == HARMLESS[1] else REJECTED for m in mutants
    }, [verdict.reason for verdict in run.verdicts]
    assert run.rate == 1.0


def test_what_scenes_do_not_see_survives_with_a_reason_and_is_kept(
    fmu: PythonFmu, python_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    short = faulty_fmus.scene(tmp_path)  # neither a load nor bristles, and only the position
    (load,) = chosen(fmu, [("component.py", "load acts 1 % too large")])
    refused = next(m for m in fmu_mutants(fmu, ["values.py"]) if "raise refused" in m.change)

    def run_kept() -> MutationRun:
        tried, journal = [load, refused], tmp_path / "verdicts"
        return run_mutants(
            python_fmu, fmu, tried, [short], made=2, jobs=1, probes=2, journal=journal
        )

    run = run_kept()
    survivor, unreached = run.verdicts
    assert survivor.status == SURVIVED
    assert "probe_" in survivor.reason
    assert "the 1 scenes that execute it pass" in survivor.reason
    assert unreached.status == NOT_REACHED
    assert run.rate == 0.0
    monkeypatch.delattr(StagedTrials, "judge")  # nothing is left to be judged
    assert run_kept().verdicts == run.verdicts


def test_an_fmu_that_is_rejected_itself_is_refused(fmu: PythonFmu, tmp_path: Path) -> None:
    (mutant,) = chosen(fmu, [("component.py", "slider_mass acts 1 % too large")])
    faulty = tmp_path / "faulty.fmu"
    fmu.write(faulty, {mutant.path: mutant.new})
    scene = faulty_fmus.scene(tmp_path)
    with pytest.raises(FmuError, match=r"rejected before anything is changed: scene short: pos"):
        run_mutants(faulty, read_python_fmu(faulty), [mutant], [scene], made=1, jobs=1)
