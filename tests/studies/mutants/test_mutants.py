"""Mutants: how they are made, judged and listed."""

from collections import Counter
from pathlib import Path

import pytest

from fmu_src.building.c_sources import slider_sources
from slider_resonator.checks.measuring import Measurement
from slider_resonator.errors import HarnessError
from studies.mutants import judging
from studies.mutants.archive import DESCRIPTION, PythonFmu, read_python_fmu
from studies.mutants.bench import Judging
from studies.mutants.changes import Change, hand_written_changes
from studies.mutants.enumerate_fmu import fmu_mutants, sample
from studies.mutants.enumerate_source import source_mutants
from studies.mutants.listing import print_run, summary
from studies.mutants.mutant import KINDS, Mutant
from studies.mutants.runs import run_mutants
from studies.mutants.trial import BenchPoint, worse_result
from studies.mutants.verdict import EQUIVALENT, REJECTED, SURVIVED, MutationRun, Verdict
from tests.harness import faulty_fmus
from tests.harness.golden import screen
from tests.harness.scene_text import read_scene

CHANGES_OF_C = hand_written_changes()
NO_FAULTS = {"component/parameter_values.c", "component/variables.c", "fmi/fmi2_version.c"}
"""Sources that are generated or only name."""


def test_each_change_fits_the_sources_and_faults_are_in_each_file() -> None:
    sources, names = slider_sources(), Counter(change.name for change in CHANGES_OF_C)
    for change in CHANGES_OF_C:
        assert change.applied(sources) != sources[change.file]
        assert change.meaning
    assert [name for name, count in names.items() if count > 1] == []
    units = {name for name in sources if name.endswith(".c")} - NO_FAULTS
    assert units - {change.file for change in CHANGES_OF_C if not change.harmless} == set()


@pytest.mark.parametrize(
    ("sources", "said"),
    [
        ({"a.c": "z"}, r"some_fault: 'x' occurs 0 times in a\.c; must be once"),
        ({"a.c": "x x"}, r"some_fault: 'x' occurs 2 times"),
        ({}, r"some_fault: a\.c is not among the C sources"),
    ],
)
def test_a_text_that_is_gone_or_ambiguous_is_refused(sources: dict[str, str], said: str) -> None:
    with pytest.raises(HarnessError, match=said):
        Change("some_fault", "a.c", "x", "y", "nothing").applied(sources)


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


def test_a_sample_keeps_the_order_and_is_drawn_by_its_seed(mutants: list[Mutant]) -> None:
    some = sample(mutants, 20, seed=3)
    assert some == sample(mutants, 20, seed=3)
    assert some != sample(mutants, 20, seed=4)
    places = [mutants.index(m) for m in some]
    assert places == sorted(set(places))
    assert sample(mutants, 10**6, seed=0) == mutants


MODULE = '''"""A module."""

LIMIT = 2.0


@dataclass(frozen=True)
class Thing:
    size: float = 1.0

    def grown(self, by: float | None = None, times: int = 3) -> float:
        """Return 1 + 1."""
        if by is not None and by > LIMIT:
            raise ValueError(f"{by + 1} is above {LIMIT}")
        while times:
            times -= 1
            if note(times):
                break
        return self.size * by
'''
CHANGES = """
3: 2.0 becomes 2.02
3: 2.0 becomes 3.0
8: 1.0 becomes 1.01
8: 1.0 becomes 2.0
10: 3 becomes 4
12: test becomes its negation
12: is not becomes is
12: and becomes or
12: > becomes <=
12: > becomes >=
13: "raise ValueError(f\'{by + 1} is above {LI..." is removed
14: test becomes its negation
15: 'times -= 1' is removed
15: - becomes +
15: 1 becomes 2
16: test becomes its negation
17: 'break' is removed
18: * becomes /
"""


def test_every_change_of_a_module() -> None:
    """Texts, annotations and what is imported stay."""
    found = source_mutants("module.py", "p/module.py", MODULE)
    assert [f"{m.line}: {m.change}" for m in found] == CHANGES.strip().splitlines()


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


BOUNDED = """
name = "bounded"
title = "An estimate with a bound"
run = { stop_time = 0.01, step_size = 0.01 }
expect = [{ quantity = "slow_motion_error", at_most = 1e-6, why = "a bound" }]
"""


@pytest.mark.parametrize(("found", "worse"), [(2.0e-7, False), (2.2e-7, True), (0.0, False)])
def test_a_result_may_come_nearer_to_its_bound_by_a_share_of_that(
    tmp_path: Path, found: float, worse: bool
) -> None:
    (tmp_path / "bounded.toml").write_text(BOUNDED)
    (point,) = read_scene(tmp_path / "bounded.toml").points()
    bench = BenchPoint(point.scene, point.at, (1e-6,), (Measurement(1.95e-7),))
    assert bool(worse_result(bench, [Measurement(found)])) is worse


REFERRED = """
name = "referred"
title = "A velocity with a reference"
run = { stop_time = 0.01, step_size = 0.01 }
expect = [{ quantity = "predicted_velocity", value = 0.1, absolute = 0.01, why = "known" }]
"""


@pytest.mark.parametrize(
    ("found", "worse"), [(0.1041, ""), (0.0959, ""), (0.1, ""), (0.1043, "predicted_velocity")]
)
def test_a_result_counts_as_worse_that_is_further_off_its_reference(
    tmp_path: Path, found: float, worse: str
) -> None:
    (tmp_path / "referred.toml").write_text(REFERRED)
    (point,) = read_scene(tmp_path / "referred.toml").points()
    bench = BenchPoint(point.scene, point.at, (0.1,), (Measurement(0.1041),))
    assert worse_result(bench, [Measurement(found)]) == (f"{worse} of referred" if worse else "")


def test_the_rate_counts_only_what_worse_result(run: MutationRun[Mutant]) -> None:
    assert run.rate == 0.75
    assert "rejected 3 of the 4 faults that make a result worse: 75.00%" in summary(run)
    assert MutationRun[Mutant]("my.fmu", 1, (), 0.0).rate is None
    assert run.tally("file")["a.py"] == run.counts
    assert run.rejections() == [("stuck: velocity", 3)]


def test_survivors_and_false_alarms_are_printed_with_reasons() -> None:
    survived = Verdict(FAULT, SURVIVED, reason="passes")
    alarm = Verdict(HARMLESS, REJECTED, "scene", "position", "off")
    run = MutationRun("x.fmu", 2, (Verdict(FAULT, *SEEN), survived), 12.3, (alarm,))
    printed = screen(lambda console: print_run(console, run), 100)
    assert "SURVIVED seen\n     passes\na.c: breaks it\n-x\n+y" in printed
    assert "FALSE ALARM fine\n     scene: position: off" in printed
    assert "rejected 1 of 1 harmless variants" in printed
