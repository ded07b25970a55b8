"""The verdict on a cell, from what was observed."""

from __future__ import annotations

import re

from harness.extremes.cell import Cell
from harness.extremes.equality import equalities
from harness.extremes.invariants import invariants
from harness.extremes.observe import Observation
from harness.extremes.verdict import FAILED, PASSED, REFUSED, Check, Verdict
from harness.interface import INPUTS, PARAMETERS

NAMES = "|".join([*PARAMETERS, *INPUTS, "communicationStepSize"])
NAMED = re.compile(rf"\b({NAMES}) = (\S+) refused\b.*\bmust ")
MOST_COST = 1000.0
"""Cost of a step, per drive period in it but at least one, over that of a period, that is allowed:
a step may have to tabulate friction, or to find events that nearly coincide."""


def judge(cell: Cell, seen: Observation) -> Verdict:
    """Return the verdict on a cell that ran to its end or was refused."""
    if seen.refusal is not None:
        named = refused_by_name(cell, seen.refusal)
        return _verdict(cell, REFUSED if named else FAILED, seen.refusal)
    checks = list(invariants(cell, seen))
    if checks[0].passed:
        checks.extend(equalities(cell, seen))
    checks.append(_cost(seen))
    failed = [check for check in checks if not check.passed]
    if failed:
        reason = "; ".join(f"{check.name}: {check.words}" for check in failed)
        return _verdict(cell, FAILED, reason, tuple(checks), seen)
    return _verdict(cell, PASSED, "", tuple(checks), seen)


def refused_by_name(cell: Cell, text: str) -> bool:
    """Whether a refusal names a variable or the step, its value here, and what is allowed."""
    found = NAMED.search(text)
    if found is None:
        return False
    name, value = found.groups()
    if name == "communicationStepSize":
        present = {hold.size for hold in (*cell.holds, *cell.other_holds)} | {cell.period}
    elif name in INPUTS:
        present = {float(getattr(hold, name)) for hold in cell.holds}
    else:
        present = {float(getattr(cell.device, name))}
    return any(value == repr(one) for one in present)


def _cost(seen: Observation) -> Check:
    ratio = seen.worst_step / seen.period_cost if seen.period_cost > 0.0 else 0.0
    words = f"the dearest step costs {ratio:.3g} drive periods of the device, allowed {MOST_COST:g}"
    return Check("cost of a step", ratio / MOST_COST, words, is_deviation=False)


def broken(cell: Cell, reason: str) -> Verdict:
    """Return the verdict on a cell that hung, or ended its process."""
    return _verdict(cell, FAILED, reason)


def _verdict(
    cell: Cell,
    verdict: str,
    reason: str,
    checks: tuple[Check, ...] = (),
    seen: Observation | None = None,
) -> Verdict:
    return Verdict(
        cell.axis,
        cell.value,
        cell.model.name,
        verdict,
        reason,
        checks,
        seen.worst_step if seen else 0.0,
        seen.period_cost if seen else 0.0,
    )
