"""Judge a cell by its observation."""

from __future__ import annotations

import re
from dataclasses import replace

from slider_resonator.device.interface import INPUTS, PARAMETERS
from slider_resonator.stress.case import MatrixCell
from slider_resonator.stress.equality import equalities
from slider_resonator.stress.invariants import invariants
from slider_resonator.stress.observe import Observation
from slider_resonator.stress.verdict import (
    FAILED,
    PASSED,
    REFUSED,
    BoundCheck,
    CellVerdict,
)

NAMES = "|".join([*PARAMETERS, *INPUTS, "communicationStepSize"])
NAMED = re.compile(rf"\b({NAMES}) = (\S+) refused\b.*\bmust ")
MAX_RELATIVE_COST = 1000.0
"""Maximum cost of a step, per period it spans (at least 1), relative to a drive period.

A step may have to tabulate friction, or to find events that nearly coincide."""


def judge(cell: MatrixCell, seen: Observation) -> CellVerdict:
    """Return the verdict on a cell that ran to its end or was refused."""
    if seen.refusal is not None:
        named = refused_by_name(cell, seen.refusal)
        return _verdict(cell, REFUSED if named else FAILED, seen.refusal)
    checks = list(invariants(cell, seen))
    if checks[0].passed:
        checks.extend(equalities(cell, seen))
    checks.append(_cost(seen))
    reason = "; ".join(f"{check.name}: {check.words}" for check in checks if not check.passed)
    return replace(
        _verdict(cell, FAILED if reason else PASSED, reason),
        checks=tuple(checks),
        worst_step=seen.worst_step,
        period_cost=seen.period_cost,
    )


def refused_by_name(cell: MatrixCell, text: str) -> bool:
    """Return whether a refusal names a variable or the step, its value and the requirement."""
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


def _cost(seen: Observation) -> BoundCheck:
    ratio = seen.worst_step / seen.period_cost if seen.period_cost > 0.0 else 0.0
    words = (
        f"the most expensive step costs {ratio:.3g} drive periods of the device, "
        f"allowed {MAX_RELATIVE_COST:g}"
    )
    return BoundCheck("cost of a step", ratio / MAX_RELATIVE_COST, words, is_deviation=False)


def broken(cell: MatrixCell, reason: str) -> CellVerdict:
    """Return the verdict on a cell that crashed or exceeded its time limit."""
    return _verdict(cell, FAILED, reason)


def _verdict(cell: MatrixCell, verdict: str, reason: str) -> CellVerdict:
    return CellVerdict(cell.axis, cell.value, cell.model.name, verdict, reason)
