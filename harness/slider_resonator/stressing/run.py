"""Running and judging cases in an FMU, which runs in processes of its own."""

import re
import shlex
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from slider_resonator.device.interface import INPUTS, PARAMETERS
from slider_resonator.errors import FmuError
from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.fmu.isolation.tasks import LocalProcesses, run_all_tasks
from slider_resonator.fmu.opening import lacking, open_fmu
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.output.readable import number_of, one_line
from slider_resonator.output.shown import Shown, Tabular
from slider_resonator.stressing import comparisons
from slider_resonator.stressing.case import RANDOM, Case, Observation, name_of, observe
from slider_resonator.stressing.comparisons import NO_REFERENCE, REFERENCE
from slider_resonator.stressing.invariants import BoundCheck, finite, invariants

PASSED = "passed"
REFUSED = "refused by name"
FAILED = "failed"
SENSITIVE = "sensitive"
MEANINGS = {
    PASSED: "all is within its bounds",
    REFUSED: "the FMU refused it, with name, value and what it must be",
    FAILED: "a bound is broken, or the FMU crashed or hung",
    SENSITIVE: "a random device whose reference, with values off by the allowed error, is as far",
    NO_REFERENCE: "a random device whose reference could not follow the motion",
}
"""Verdict to what it means."""

_NAMES = "|".join([*PARAMETERS, *INPUTS, "communicationStepSize"])
_NAMED = re.compile(rf"\b({_NAMES}) = (\S+) refused\b.*\bmust ")
MAX_RELATIVE_COST = 1000.0
"""Maximum cost of a step, per period it spans (at least 1), relative to a drive period.

A step may have to tabulate friction, or to find events that nearly coincide."""


@dataclass(frozen=True)
class Verdict:
    """The verdict on one case, the bounds behind it, and the reason where it did not pass."""

    axis: str
    value: str
    model: str
    verdict: str
    reason: str = ""
    checks: tuple[BoundCheck, ...] = ()
    worst_step: float = 0.0
    period_cost: float = 0.0

    @property
    def name(self) -> str:
        """Axis, value and model, as of the case."""
        return f"{self.axis}: {self.value}: {self.model}"

    @property
    def cost_ratio(self) -> float:
        """Worst cost of a step, per period it spans (at least 1), relative to a period."""
        return self.worst_step / self.period_cost if self.period_cost > 0.0 else 0.0

    @property
    def nearest(self) -> BoundCheck | None:
        """The deviation that is nearest to its bound, or farthest beyond it."""
        deviations = [check for check in self.checks if check.is_deviation]
        return max(deviations, key=lambda check: check.found, default=None)

    def command(self, fmu: str) -> str:
        """Return the command that runs the case again and prints its values."""
        return shlex.join(("slider-resonator", "stress", fmu, "--case", self.name))


def verdict_on(case: Case, verdict: str, reason: str = "") -> Verdict:
    """Return a verdict on a case without checks: a refusal, a crash, an exceeded limit."""
    return Verdict(case.axis, case.value, name_of(case.model), verdict, reason)


def refused_by_name(case: Case, text: str) -> bool:
    """Return whether a refusal names a variable or the step, its value and the requirement."""
    found = _NAMED.search(text)
    if found is None:
        return False
    name, value = found.groups()
    if name == "communicationStepSize":
        present = {hold.size for hold in (*case.holds, *case.other_holds)} | {case.period}
    elif name in INPUTS:
        present = {float(getattr(hold, name)) for hold in case.holds}
    else:
        first = float(getattr(case.device, name))
        present = {dict(hold.tuned).get(name, first) for hold in case.holds}
    return any(value == repr(one) for one in present)


def judge(case: Case, seen: Observation) -> Verdict:
    """Return the verdict on a case that ran to its end or was refused.

    A random case is judged by its reference alone, and passes over what that does not say.
    """
    if seen.refusal is not None:
        named = refused_by_name(case, seen.refusal)
        return verdict_on(case, REFUSED if named else FAILED, seen.refusal)
    checks = [finite(seen)]
    if checks[0].passed:
        if not case.is_random:
            checks += [*invariants(case, seen), *comparisons.equalities(case, seen)]
        if comparisons.has_reference(case):
            checks.append(comparisons.compare_with_reference(case, seen))
    last = checks[-1]
    judged = verdict_on(case, PASSED)
    judged = replace(judged, worst_step=seen.worst_step, period_cost=seen.period_cost)
    if not case.is_random:
        words = (
            f"the most expensive step costs {judged.cost_ratio:.3g} drive periods of the device, "
            f"allowed {MAX_RELATIVE_COST:g}"
        )
        share = judged.cost_ratio / MAX_RELATIVE_COST
        checks.append(BoundCheck("cost of a step", share, words, is_deviation=False))
    reason = "; ".join(f"{check.name}: {check.words}" for check in checks if not check.passed)
    verdict = FAILED if reason else PASSED
    if case.is_random and last.name == NO_REFERENCE:
        verdict, reason = NO_REFERENCE, last.words
    elif case.is_random and last.name == REFERENCE and not last.passed:
        verdict = SENSITIVE if comparisons.is_sensitive(case, last.found) else FAILED
    return replace(judged, verdict=verdict, reason=reason, checks=tuple(checks))


TIME_LIMIT = 300.0
"""Time limit of a case, s."""


@dataclass(frozen=True, repr=False)
class StressResult(Shown, Tabular):
    """The verdicts on an FMU, one for each case that ran, and the wall time in s.

    Cases were `skipped` that do not apply to the FMU; an interrupted run has some that were
    `not_run`.
    """

    fmu: str
    verdicts: tuple[Verdict, ...]
    wall_time: float
    not_run: int = 0
    skipped: int = 0

    def table(self) -> dict[str, list[Any]]:
        """Return the verdicts in columns."""
        names = ("axis", "value", "model", "verdict", "reason")
        return {name: [getattr(one, name) for one in self.verdicts] for name in names}

    def describe(self) -> list[str]:
        """Return the verdict, the counts, and the cases that did not pass."""
        return ["passed" if self.passed else "FAILED", *self.sentences()]

    def sentences(self) -> list[str]:
        """Return what was found, in lines; a failed case has the command that runs it again."""
        lines = f"{one_line(self.fmu)}: {self.summary}".splitlines()
        for case in self.verdicts:
            if case.verdict not in (PASSED, NO_REFERENCE):
                lines.append(f"  {case.verdict}: {case.name}: {one_line(case.reason)}")
            if case.verdict == FAILED:
                lines.append(f"    {one_line(case.command(self.fmu))}")
        return lines

    @property
    def counts(self) -> dict[str, int]:
        """Verdict to count; passed, refused and failed are always there."""
        none = dict.fromkeys((PASSED, REFUSED, FAILED), 0)
        return none | Counter(one.verdict for one in self.verdicts)

    @property
    def nearest(self) -> dict[str, tuple[Verdict, BoundCheck]]:
        """For each model the passed case that is nearest to a bound, and that bound."""
        passed = [one for one in self.verdicts if one.verdict == PASSED]
        pairs = [(one, check) for one in passed if (check := one.nearest)]
        return {one.model: (one, check) for one, check in sorted(pairs, key=lambda p: p[1].found)}

    @property
    def passed(self) -> bool:
        """Whether all cases ran, none failed, and next to no random device was refused."""
        return not (self.failed or self.not_run)

    @property
    def failed(self) -> bool:
        """Whether a case failed, or more than 2 % of the random devices were refused."""
        drawn = [one for one in self.verdicts if one.axis == RANDOM]
        refused = sum(one.verdict == REFUSED for one in drawn)
        return self.counts[FAILED] > 0 or refused > max(1.0, 0.02 * len(drawn))

    @property
    def most_expensive(self) -> Verdict | None:
        """The case with the worst cost of a step relative to a period of its device."""
        worst = max(self.verdicts, key=lambda one: one.cost_ratio, default=None)
        return worst if worst and worst.cost_ratio else None

    @property
    def summary(self) -> str:
        """The counts, the worst cost and the cases nearest to a bound, in lines."""
        made = Counter(check.name for one in self.verdicts for check in one.checks)
        counts = ", ".join(f"{count} {verdict}" for verdict, count in self.counts.items())
        lines = [
            f"{number_of(len(self.verdicts), 'case')}: {counts}, {self.skipped} skipped, "
            f"{self.not_run} not run; {self.wall_time:.0f} s",
            f"{number_of(made[REFERENCE], 'case')} compared with a reference, "
            f"which gave up in {made[NO_REFERENCE]} others",
        ]
        worst = self.most_expensive
        if worst is not None:
            lines.append(
                f"worst cost of a step, per drive period it spans (at least 1): "
                f"{worst.cost_ratio:.3g} times the median cost of a period of the same device "
                f"(bound {MAX_RELATIVE_COST:g}), {1e6 * worst.worst_step:.3g} us ({worst.name})"
            )
        lines += [
            f"nearest to a bound, {model}: {check.found:.2g} of it in {check.name}, "
            f"{case.axis}: {case.value}"
            for model, (case, check) in self.nearest.items()
        ]
        return "\n".join(lines)


def applicable(fmu: Path, cases: Sequence[Case]) -> list[Case]:
    """Return the cases that an FMU has what they need for; FmuError when there is none.

    Averages of second order need `averaging_order`, unequal steps an FMU that takes them.
    """
    with open_fmu(fmu) as opened:
        has_orders, equal_only = opened.has_orders, opened.takes_equal_steps_only
    chosen = [
        case
        for case in cases
        if (has_orders or not case.model.leaps)
        and not (equal_only and len({hold.size for hold in case.holds}) > 1)
    ]
    if not chosen:
        lacks = ", ".join(lacking(fmu))
        why = f"it lacks {lacks}" if lacks else "it takes equal steps only"
        raise FmuError(f"{fmu}: no case applies to this FMU: {why}")
    return chosen


def run_cases(
    fmu: Path,
    cases: Sequence[Case],
    progress: Progress = no_progress,
    time_limit: float = TIME_LIMIT,
    *,
    jobs: int = 1,
    chosen: Sequence[Case] = (),
    keep: Callable[[StressResult], None] = lambda result: None,
) -> StressResult:
    """Run and judge the cases that apply; FmuError when none does or the FMU cannot be run at all.

    `chosen` are those that apply, for a caller that has them from `applicable`. A crash or a missed
    `time_limit` (s) fails its case only. An FMU without fault gets up to `jobs` processes. `keep`
    is called with what there is when the run is interrupted or stopped by an error.
    """
    began = time.perf_counter()
    verdicts: list[Verdict] = []
    chosen = chosen or applicable(fmu, cases)

    def result() -> StressResult:
        seconds, left = time.perf_counter() - began, len(chosen) - len(verdicts)
        return StressResult(str(fmu), tuple(verdicts), seconds, left, len(cases) - len(chosen))

    tasks = [(case, partial(observe, case=case)) for case in chosen]
    try:
        with LocalProcesses(fmu, time_limit, jobs) as processes:
            for case, outcome in run_all_tasks(processes, tasks):
                done, label = len(verdicts), case.value if case.is_random else case.axis
                progress(counted(f"{fmu.name}: {label}", done, len(chosen)), done / len(chosen))
                if isinstance(outcome.error, FmuDied):
                    verdicts.append(verdict_on(case, FAILED, str(outcome.error)))
                else:
                    verdicts.append(judge(case, outcome.result()))
    except BaseException:
        if verdicts:
            keep(result())
        raise
    return result()
