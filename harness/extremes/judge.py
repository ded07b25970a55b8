"""The verdict on a cell, from what was observed."""

from __future__ import annotations

import re

from harness.extremes.cell import Cell
from harness.extremes.equality import equalities
from harness.extremes.invariants import invariants
from harness.extremes.observe import Observation
from harness.extremes.verdict import FAILED, PASSED, REFUSED, Check, Verdict
from harness.interface import INPUTS, PARAMETERS

NAMED = re.compile(rf"\b({'|'.join([*PARAMETERS, *INPUTS, 'communicationStepSize'])})\b")


def judge(cell: Cell, seen: Observation) -> Verdict:
    """Return the verdict on a cell that ran to its end or was refused."""
    if seen.refusal is not None:
        named = "refused" in seen.refusal and NAMED.search(seen.refusal) is not None
        return _verdict(cell, REFUSED if named else FAILED, seen.refusal)
    checks = list(invariants(cell, seen))
    if checks[0].passed:
        checks.extend(equalities(cell, seen))
    failed = [check for check in checks if not check.passed]
    if failed:
        reason = "; ".join(f"{check.name}: {check.words}" for check in failed)
        return _verdict(cell, FAILED, reason, tuple(checks), seen)
    return _verdict(cell, PASSED, "", tuple(checks), seen)


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
