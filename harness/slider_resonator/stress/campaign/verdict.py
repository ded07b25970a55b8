"""The verdict on a case, and its place in the result."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.leap_error import centre_signals
from slider_resonator.stress.campaign.expected import CONDITIONING, Expected, expected, moved
from slider_resonator.stress.campaign.random_case import RandomCase
from slider_resonator.stress.campaign.second_order import of_second_order

PASSED, FAILED, REFUSED = "passed", "failed", "refused"
NO_REFERENCE, SENSITIVE = "no reference", "sensitive"


@dataclass(frozen=True)
class CaseVerdict:
    """A verdict with its reason; `found` is the largest deviation over what is allowed.

    `sensitive` is a motion that the reference itself, with values off by the allowed error, departs
    from as far.
    """

    number: int
    model: str
    verdict: str
    found: float = 0.0
    signal: str = ""
    reason: str = ""


def judge(case: RandomCase, record: Mapping[str, Array]) -> CaseVerdict:
    """Return the verdict on the outputs of a run, by name, shape (n,)."""
    for name, values in record.items():
        if not np.isfinite(values).all():
            reason = f"{name} is not finite"
            return CaseVerdict(case.number, case.model, FAILED, np.inf, name, reason)
    try:
        reference = expected(case)
    except (RuntimeError, ValueError, ArithmeticError) as error:
        return CaseVerdict(case.number, case.model, NO_REFERENCE, reason=str(error))
    if case.second_order:
        reference = of_second_order(case, reference)
        record = centre_signals(case.device, record)
    found, signal, words = _worst(record, reference)
    if found <= 1.0:
        return CaseVerdict(case.number, case.model, PASSED, found, signal)
    try:
        near = moved(case, reference.resolution).signals
        if case.second_order:
            near = centre_signals(case.device, near)
        own, _, _ = _worst(near, reference)
    except (RuntimeError, ValueError, ArithmeticError):
        own = 0.0
    verdict = SENSITIVE if found <= CONDITIONING * own else FAILED
    reason = f"{words}; the reference with values off by {reference.resolution:.2g}: {own:.3g}"
    return CaseVerdict(case.number, case.model, verdict, found, signal, reason)


def _worst(record: Mapping[str, Array], reference: Expected) -> tuple[float, str, str]:
    """Return the largest deviation over what is allowed, where, in words."""
    found, signal, words = 0.0, "", ""
    for name, there in reference.signals.items():
        # There is no mean over a period before the first step.
        begin = int(name == "mean_velocity")
        off = float(np.abs(record[name] - there)[begin:].max())
        allowed = reference.allowed[name]
        ratio = off / allowed if allowed else 2.0 * float(off > 0.0)
        if not ratio <= found:
            found, signal = ratio, name
            words = f"{name} off by {off:.3g}, allowed {allowed:.3g}"
    return found, signal, words
