"""Judge a case by its observation."""

from __future__ import annotations

from dataclasses import replace

from slider_resonator.stress.case import Case
from slider_resonator.stress.comparisons import (
    compare_with_reference,
    equalities,
    has_reference,
    is_sensitive,
)
from slider_resonator.stress.invariants import finite, invariants
from slider_resonator.stress.observe import Observation
from slider_resonator.stress.verdict import (
    FAILED,
    NO_REFERENCE,
    PASSED,
    REFERENCE,
    REFUSED,
    SENSITIVE,
    BoundCheck,
    Verdict,
    refused_by_name,
    verdict_on,
)

MAX_RELATIVE_COST = 1000.0
"""Maximum cost of a step, per period it spans (at least 1), relative to a drive period.

A step may have to tabulate friction, or to find events that nearly coincide."""


def judge(case: Case, seen: Observation) -> Verdict:
    """Return the verdict on a case that ran to its end or was refused.

    A random case is judged by its reference alone, and passes over what that does not say.
    """
    if seen.refusal is not None:
        named = refused_by_name(case, seen.refusal)
        return verdict_on(case, REFUSED if named else FAILED, seen.refusal)
    checks = [finite(seen)]
    if checks[0].passed:
        checks += [] if case.is_random else [*invariants(case, seen), *equalities(case, seen)]
        checks += [compare_with_reference(case, seen)] if has_reference(case) else []
    checks += [] if case.is_random else [_cost(seen)]
    reason = "; ".join(f"{check.name}: {check.words}" for check in checks if not check.passed)
    return replace(
        verdict_on(case, FAILED if reason else PASSED, reason),
        **(_of_reference(case, checks[-1]) if case.is_random else {}),
        checks=tuple(checks),
        worst_step=seen.worst_step,
        period_cost=seen.period_cost,
    )


def _of_reference(case: Case, check: BoundCheck) -> dict[str, str]:
    """Return verdict and reason where the reference of a random case says nothing about it."""
    if check.name == NO_REFERENCE:
        return {"verdict": NO_REFERENCE, "reason": check.words}
    if check.name == REFERENCE and not check.passed and is_sensitive(case, check.found):
        return {"verdict": SENSITIVE}
    return {}


def _cost(seen: Observation) -> BoundCheck:
    ratio = seen.worst_step / seen.period_cost if seen.period_cost > 0.0 else 0.0
    words = (
        f"the most expensive step costs {ratio:.3g} drive periods of the device, "
        f"allowed {MAX_RELATIVE_COST:g}"
    )
    return BoundCheck("cost of a step", ratio / MAX_RELATIVE_COST, words, is_deviation=False)
