"""What the stages make of mutants that hide each other, with a stand-in for the trials."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import cast

from studies.mutants.archive import PythonFmu
from studies.mutants.attempt import Attempt, Attempted, Bench
from studies.mutants.mutant import Mutant
from studies.mutants.staged_trials import StagedTrials
from studies.mutants.trial import ExpectedPoint, Rejection
from studies.mutants.trial_client import TrialServers
from studies.mutants.verdict import REJECTED, MutantVerdict

CHEAP, SCENE, PROBE = range(3)
COSTS = (1.0, 2.0, 3.0)
ORIGINAL = "a = 1\nb = 1\n"


def mutant(line: int, new: str) -> Mutant:
    return Mutant("m.py", "resources/m.py", line, 5, "constant", "1 becomes 2", line, ORIGINAL, new)


FAULTY, HIDING = mutant(1, "a = 2\nb = 1\n"), mutant(2, "a = 1\nb = 2\n")


@dataclass
class Trials:
    """Reject `a = 2`: at the probe always, at the scene unless `b = 2` hides it."""

    alone: list[Sequence[int]] = field(default_factory=list)

    def attempt(self, attempt: Attempt) -> Attempted:
        (source,) = (text.decode() for text in attempt.changed.values())
        faulty, hidden = "a = 2" in source, "b = 2" in source
        if not attempt.noting:
            self.alone.append(attempt.points)
        for point in attempt.points:
            if faulty and (point == PROBE or (point == SCENE and not hidden)):
                return Attempted(Rejection(f"point {point}", "position", "off"), point)
        places = frozenset({("m.py", 1), ("m.py", 2)})
        return Attempted(None, None, dict.fromkeys(attempt.points, places))


def test_a_fault_that_another_mutant_hides_in_their_group_is_rejected_alone() -> None:
    trials = Trials()
    points = cast("Sequence[ExpectedPoint]", (None, None, None))
    bench = Bench(Path("none.fmu"), points, COSTS, time_limit=1.0)
    reach = [{("m.py", 1), ("m.py", 2)}] * 3
    verdicts: list[MutantVerdict] = []
    with ThreadPoolExecutor(1) as pool:
        servers = cast("TrialServers", trials)
        staged = StagedTrials(cast("PythonFmu", None), bench, reach, 2, servers, pool)
        staged.judge([FAULTY, HIDING], verdicts.append)
    statuses = {verdict.mutant: (verdict.status, verdict.scene) for verdict in verdicts}
    assert statuses[FAULTY] == (REJECTED, f"point {SCENE}")
    assert [CHEAP, SCENE] in trials.alone
