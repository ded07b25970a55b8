"""Judge mutants in stages: alone on a few scenes, in groups on all, and on random probes.

The cheapest scenes and those that have rejected other mutants of a module reject most. What passes
those is tried on all scenes in groups; what passes all scenes on probes, whose results are the
original's. What a probe rejects is tried alone on all scenes: others of its group may have hidden
what it does there. What they hide on the probes, too, counts as equivalent.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Collection, Mapping, Sequence
from concurrent.futures import Executor, as_completed

from slider_resonator.output.temporary import temporary_folder
from studies.mutants.archive import PythonFmu
from studies.mutants.attempt import Attempt, Bench
from studies.mutants.combined import combined_sources, groups_of
from studies.mutants.group_trials import Outcome, rejected_members
from studies.mutants.mutant import Mutant
from studies.mutants.reach import Place
from studies.mutants.rejecting_points import RejectingPoints
from studies.mutants.trial import Rejection, trial
from studies.mutants.trial_client import TrialServers
from studies.mutants.verdict import (
    EQUIVALENT,
    NOT_REACHED,
    REJECTED,
    SURVIVED,
    MutantVerdict,
)

QUICK = 0.3
"""CPU time (s) of the original on the scenes on which a mutant is tried alone."""
GROUP = 512
"""Maximum mutants that are tried in one FMU."""

Keep = Callable[[MutantVerdict], None]


class StagedTrials:
    """Trials of mutants of `fmu` on a bench, whose first `scenes` points are scenes, then probes.

    `reach` has the places that the original executes at each point. `pool` runs as many trials at a
    time as there are `servers`.
    """

    def __init__(
        self,
        fmu: PythonFmu,
        bench: Bench,
        reach: Sequence[Collection[Place]],
        scenes: int,
        servers: TrialServers,
        pool: Executor,
    ) -> None:
        self._fmu = fmu
        self._bench = bench
        self._reach = reach
        order = sorted(range(len(bench.points)), key=bench.costs.__getitem__)
        self._scenes = [point for point in order if point < scenes]
        self._probes = [point for point in order if point >= scenes]
        self._servers = servers
        self._pool = pool
        self._rejecting = RejectingPoints()

    def judge(self, mutants: Sequence[Mutant], keep: Keep) -> None:
        """Hand the verdict on each mutant to `keep`, as soon as it is known."""
        left: dict[Mutant, list[int]] = {}
        for future in as_completed([self._pool.submit(self._alone, m) for m in mutants]):
            mutant, verdict, others = future.result()
            if verdict is not None:
                keep(verdict)
            else:
                left[mutant] = others
        lock = threading.Lock()

        def reject(mutant: Mutant, rejection: Rejection) -> None:
            with lock:
                keep(_rejected(mutant, rejection))

        def differ(mutant: Mutant, rejection: Rejection) -> None:
            verdict = self._alone_on_all(mutant, rejection)
            with lock:
                keep(verdict)

        passed = self._in_groups(left, self._scenes, reject)
        probes = {mutant: self._through(mutant, self._probes) for mutant in passed}
        for mutant in self._in_groups(probes, self._probes, differ):
            keep(self._equivalent(mutant))

    def _alone(self, mutant: Mutant) -> tuple[Mutant, MutantVerdict | None, list[int]]:
        """Try a mutant on a few scenes; return its verdict, if any, and the other scenes."""
        scenes = self._through(mutant, self._scenes)
        if not scenes and not self._through(mutant, self._probes):
            reason = "no scene and no probe executes the statement"
            return mutant, MutantVerdict(mutant, NOT_REACHED, reason), []
        if mutant.kind == "unit":
            return mutant, self._packed(mutant), []
        quick = self._quick(mutant, scenes)
        found = self._servers.attempt(Attempt({mutant.path: mutant.new.encode()}, quick))
        if found.rejection is None:
            return mutant, None, [point for point in scenes if point not in quick]
        if found.at is not None:
            self._rejecting.add(mutant.file, found.at)
        return mutant, _rejected(mutant, found.rejection), []

    def _packed(self, mutant: Mutant) -> MutantVerdict:
        """Try a mutant of the model description, which is read when an FMU is opened."""
        points = [self._bench.points[number] for number in self._scenes]
        with temporary_folder() as folder:
            faulty = folder / "mutant.fmu"
            self._fmu.write(faulty, {mutant.path: mutant.new})
            rejection = trial(faulty, points, self._bench.time_limit)
        if rejection is not None:
            return _rejected(mutant, rejection)
        return MutantVerdict(mutant, SURVIVED, "the interface is accepted with that unit")

    def _quick(self, mutant: Mutant, scenes: Sequence[int]) -> list[int]:
        """Return the scenes that are likely to reject a mutant, and cheap ones."""
        chosen, cost = [], 0.0
        for point in self._rejecting.first(mutant.file, scenes):
            chosen.append(point)
            cost += self._bench.costs[point]
            if cost > QUICK:
                break
        return chosen

    def _through(self, mutant: Mutant, points: Sequence[int]) -> list[int]:
        """Return those of the points at which a mutant can make a difference."""
        if mutant.statement is None:
            return list(points)
        place = (mutant.file, mutant.statement)
        return [point for point in points if place in self._reach[point]]

    def _in_groups(
        self,
        points: Mapping[Mutant, Sequence[int]],
        order: Sequence[int],
        report: Callable[[Mutant, Rejection], None],
    ) -> list[Mutant]:
        """Try mutants in groups; return those that pass all of their points."""

        def tried(group: list[Mutant]) -> set[Mutant]:
            own = {mutant: points[mutant] for mutant in group}
            return rejected_members(self._together, own, order, report)

        groups = groups_of(sorted(points, key=lambda mutant: mutant.name), GROUP)
        rejected = set().union(*self._pool.map(tried, groups))
        return [mutant for mutant in points if mutant not in rejected]

    def _together(self, mutants: Sequence[Mutant], points: Sequence[int]) -> Outcome[Mutant]:
        """Try mutants in one FMU."""
        found = self._servers.attempt(Attempt(combined_sources(mutants), points, noting=True))
        passed = {
            point: frozenset(
                m for m in mutants if m.statement is None or (m.file, m.statement) in places
            )
            for point, places in found.executed.items()
        }
        return Outcome(found.rejection, found.at, passed)

    def _alone_on_all(self, mutant: Mutant, difference: Rejection) -> MutantVerdict:
        """Return the verdict on a mutant that all scenes accept in groups and a probe does not."""
        what = f"{difference.quantity or 'cannot be run'}: {difference.reason}"
        scenes = self._through(mutant, self._scenes)
        if not scenes:
            reason = f"no scene executes the statement, but {difference.scene} does: {what}"
            return MutantVerdict(mutant, SURVIVED, reason)
        found = self._servers.attempt(Attempt({mutant.path: mutant.new.encode()}, scenes))
        if found.rejection is not None:
            return _rejected(mutant, found.rejection)
        reason = f"in {difference.scene}: {what}; the {len(scenes)} scenes that execute it pass"
        return MutantVerdict(mutant, SURVIVED, reason)

    def _equivalent(self, mutant: Mutant) -> MutantVerdict:
        scenes = len(self._through(mutant, self._scenes))
        probes = len(self._through(mutant, self._probes))
        reason = f"{scenes} scenes and {probes} probes execute the statement, and all pass"
        return MutantVerdict(mutant, EQUIVALENT, reason)


def _rejected(mutant: Mutant, rejection: Rejection) -> MutantVerdict:
    return MutantVerdict(mutant, REJECTED, rejection.reason, rejection.scene, rejection.quantity)
