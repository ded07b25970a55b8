from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from slider_resonator.scenes.scene_files import find_scene
from studies.mutants import judging
from studies.mutants.archive import read_python_fmu
from studies.mutants.bench import Judging
from studies.mutants.changes import Change, hand_written_faults, harmless_variants
from studies.mutants.enumerate_fmu import fmu_mutants
from studies.mutants.enumerate_source import source_mutants
from studies.mutants.listing import print_run, summary
from studies.mutants.mutant import Mutant
from studies.mutants.runs import run_changes, run_mutants
from studies.mutants.verdict import EQUIVALENT, REJECTED, SURVIVED, MutationRun, Verdict
from tests.harness import faulty_fmus
from tests.harness.scene_text import read_scene

MUTANTS = source_mutants("a.py", "p/a.py", "def f(a, b):\n    return a < b * 2.0 + 1\n")
SEEN = (REJECTED, "stuck", "velocity", "off")
VERDICTS = (*([SEEN] * 3), (SURVIVED,), (EQUIVALENT,))
FAULT = Change("seen", "a.c", "x", "y", "breaks it")
HARMLESS = Change("fine", "b.c", "x", "[y]", "harmless", harmless=True)


@pytest.fixture
def run() -> MutationRun[Mutant]:
    verdicts = tuple(Verdict(m, *v) for m, v in zip(MUTANTS, VERDICTS, strict=False))
    return MutationRun("my.fmu", 100, verdicts, 2.0)


@pytest.mark.isolated
@pytest.mark.slow
def test_mutants_are_judged_once_and_kept(
    python_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    fmu, scene = read_python_fmu(python_fmu), read_scene(faulty_fmus.scene(tmp_path))
    made = fmu_mutants(fmu, ["device.py", "values.py"])
    wrong = next(m for m in made if m.file == "device.py" and m.change == "+ becomes -")
    unseen = next(m for m in made if "raise Refusal" in m.change)

    def run_kept() -> MutationRun[Mutant]:
        tried, journal = [wrong, unseen], tmp_path / "verdicts"
        return run_mutants(python_fmu, fmu, tried, 9, Judging([scene], 2, journal=journal))

    run = run_kept()
    assert [verdict.status for verdict in run.verdicts] == [REJECTED, EQUIVALENT]
    assert run.rate == 1.0
    monkeypatch.delattr(judging, "trial")  # nothing is left to be judged
    assert run_kept().verdicts == run.verdicts


@pytest.mark.isolated
@pytest.mark.slow
def test_faults_are_rejected_and_variants_accepted(native_fmu: Path) -> None:
    names = ("mean_before_first_period", "first_bristle_sign", "split_merges_mirror", "longer_arcs")
    changes = [c for c in (*hand_written_faults(), *harmless_variants()) if c.name in names]
    scenes = ("less_than_a_period", "lugre_less_than_a_period", "averaged_short_run")
    run = run_changes(native_fmu, changes, Judging([find_scene(scene) for scene in scenes]))
    assert [verdict.variant.name for verdict in run.survivors] == ["split_merges_mirror"]
    assert run.false_alarms == []
    assert run.rate == pytest.approx(2.0 / 3.0)
    assert all(verdict.quantity for verdict in run.verdicts if verdict.rejected)


def test_the_rate_counts_only_what_changes_a_result(run: MutationRun[Mutant]) -> None:
    assert run.rate == 0.75
    assert "rejected 3 of the 4 faults that change a result: 75.00%" in summary(run)
    assert MutationRun[Mutant]("my.fmu", 1, (), 0.0).rate is None
    assert run.tally("file")["a.py"] == run.counts
    assert run.rejections() == [("stuck: velocity", 3)]


def test_survivors_and_false_alarms_are_printed_with_reasons() -> None:
    survived = Verdict(FAULT, SURVIVED, reason="passes")
    alarm = Verdict(HARMLESS, REJECTED, "scene", "position", "off")
    run = MutationRun("x.fmu", 2, (Verdict(FAULT, *SEEN), survived), 12.3, (alarm,))
    text = StringIO()
    print_run(Console(file=text, width=100), run)
    printed = text.getvalue()
    assert "SURVIVED seen\n     passes\na.c: breaks it\n-x\n+y" in printed
    assert "FALSE ALARM fine\n     scene: position: off" in printed
    assert "rejected 1 of 1 harmless variants" in printed
