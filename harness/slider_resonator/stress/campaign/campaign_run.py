"""Running and judging the cases of a campaign in an FMU, which runs in a process of its own."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from slider_resonator.arrays import Array
from slider_resonator.errors import Refusal
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.fmu.isolation.tasks import run_all_tasks
from slider_resonator.fmu.opening import lacking
from slider_resonator.fmu.run import run
from slider_resonator.output.progress import Progress, counted
from slider_resonator.stress.campaign.expected import AVERAGED, RESOLVED
from slider_resonator.stress.campaign.random_case import RandomCase
from slider_resonator.stress.campaign.verdict import FAILED, PASSED, REFUSED, CaseVerdict, judge

TIME_LIMIT = 60.0
"""Time limit of a case, s."""
MAX_REFUSED = 0.02
"""Share of the cases that an FMU may refuse: their values are those of devices."""


@dataclass(frozen=True)
class Campaign:
    """The verdicts on an FMU, one for each case that ran; `wall_time` in s."""

    fmu: str
    seed: int
    verdicts: tuple[CaseVerdict, ...]
    wall_time: float
    not_run: int = 0

    @property
    def counts(self) -> dict[str, int]:
        """Verdict to count."""
        return dict(Counter(one.verdict for one in self.verdicts))

    @property
    def worst(self) -> dict[str, CaseVerdict]:
        """For each model the passed case that is nearest to its bound."""
        passed = sorted(
            (v for v in self.verdicts if v.verdict == PASSED), key=lambda one: one.found
        )
        return {one.model: one for one in passed}

    @property
    def passed(self) -> bool:
        """Whether all cases ran, none failed and next to none was refused."""
        return not (self.failed or self.not_run)

    @property
    def failed(self) -> bool:
        """Whether a case failed, or too many were refused."""
        refused = self.counts.get(REFUSED, 0)
        too_many = refused > max(1.0, MAX_REFUSED * len(self.verdicts))
        return bool(self.counts.get(FAILED, 0) or too_many)


def run_campaign(
    fmu: Path,
    cases: Sequence[RandomCase],
    progress: Progress,
    time_limit: float = TIME_LIMIT,
    keep: Callable[[Campaign], None] = lambda campaign: None,
) -> Campaign:
    """Run and judge the cases; FmuError when the FMU cannot be run at all.

    Cases of second order are left out for an FMU without `averaging_order`. A crash or a missed
    `time_limit` (s) fails its case only. `keep` is called with what there is
    when the run is interrupted or stopped by an error.
    """
    began = time.perf_counter()
    verdicts: list[CaseVerdict] = []
    if "averaging_order" in lacking(fmu):
        cases = [case for case in cases if not case.second_order]

    def report(case: RandomCase) -> None:
        done = len(verdicts)
        progress(counted(f"{fmu.name}: case {case.number}", done, len(cases)), done / len(cases))

    def campaign() -> Campaign:
        seconds, seed = time.perf_counter() - began, cases[0].seed if cases else 0
        return Campaign(str(fmu), seed, tuple(verdicts), seconds, len(cases) - len(verdicts))

    tasks = [(case, partial(_outputs, case=case)) for case in cases]
    try:
        finished = run_all_tasks(
            fmu,
            tasks,
            time_limit,
            name=lambda case: str(case.number),
            meanwhile=report,
            outcomes=(FmuDied, Refusal),
        )
        with closing(finished):
            for case, result, error in finished:
                if error is None:
                    verdicts.append(judge(case, result))
                    continue
                verdict = REFUSED if isinstance(error, Refusal) else FAILED
                verdicts.append(CaseVerdict(case.number, case.model, verdict, reason=str(error)))
    except BaseException:
        if verdicts:
            keep(campaign())
        raise
    return campaign()


def _outputs(instance: Instance, case: RandomCase) -> dict[str, Array]:
    """Run a case; what is raised is what `run` does."""
    first_order = case.device.fidelity == 0 and not case.second_order
    names = AVERAGED if first_order else RESOLVED
    record = run(instance, case.parameters, case.schedule, outputs=names)
    return dict(record.outputs)
