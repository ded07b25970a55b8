"""Judging one expectation: what the FMU gives, what it should be, whether that is near enough."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.measures.deviation import mismatch_share, peak, share_of
from slider_resonator.checks.measures.tube import Tube, no_tube
from slider_resonator.checks.measuring import Measurement
from slider_resonator.scenes.schema import ExpectTable
from slider_resonator.scenes.vocabulary import QUANTITIES, Quantity

Array = NDArray[np.float64]
Value = float | str | None


@dataclass(frozen=True)
class Check:
    """One expectation with its verdict.

    For a signal, `fmu` and `reference` are peaks, and `deviation` and `allowed` shares of the
    reference's peak; for a number, and for times of events, they carry its unit. `at` says what a
    sweep has varied. A signal that fails is beyond what is allowed from `first_time` (s) on and
    farthest at `worst_time` (s). A deviation is counted from the edge of a tube, where there is
    one; `tube` is its half width in drive periods.
    """

    scene: str
    quantity: str
    unit: str
    fmu: Value
    against: str
    reference: Value
    deviation: float | None
    allowed: float | None
    passed: bool
    why: str
    note: str = ""
    at: Mapping[str, float] = field(default_factory=dict)
    first_time: float | None = None
    worst_time: float | None = None
    tube: float | None = None

    @property
    def severity(self) -> float:
        """Deviation in units of what is allowed: the larger, the worse."""
        if self.deviation is None or not isfinite(self.deviation):
            return 0.0 if self.passed else float("inf")
        if self.allowed:
            return self.deviation / self.allowed
        return 0.0 if self.passed else float("inf")


def check(
    expect: ExpectTable,
    measured: Measurement,
    wanted: Any,
    scene: str,
    at: Mapping[str, float],
    smallest: float = 0.0,
) -> Check:
    """Compare a measurement with what is wanted, and judge.

    A reference nearer to zero than `smallest`, in its unit, counts as that, unless the scene says
    what is allowed in absolute terms.
    """
    quantity = QUANTITIES[expect.quantity]
    if "absolute" in expect.model_fields_set:
        smallest = 0.0
    if quantity.kind == "signal":
        return _signal_check(expect, quantity, measured, wanted, scene, at, smallest)
    deviation, allowed = _distance(expect, measured.value, wanted, smallest)
    return Check(
        scene=scene,
        quantity=expect.quantity,
        unit=quantity.unit,
        fmu=measured.value,
        against=_against(expect),
        reference=wanted,
        deviation=deviation,
        allowed=allowed,
        passed=_verdict(measured.value, wanted, deviation, allowed),
        why=expect.why,
        note=measured.note,
        at=at,
    )


def _signal_check(
    expect: ExpectTable,
    quantity: Quantity,
    measured: Measurement,
    wanted: Array | Tube,
    scene: str,
    at: Mapping[str, float],
    smallest: float,
) -> Check:
    """Compare two signals; a value that is not finite fails."""
    tube = wanted if isinstance(wanted, Tube) else no_tube(wanted)
    outside = tube.outside(measured.value)
    size = peak(tube.middle)
    floor = expect.absolute / expect.relative if expect.absolute else max(0.0, smallest - size)
    allowed = expect.relative
    if quantity.exact:
        deviation, limit = mismatch_share(outside), 0.5
    elif quantity.in_periods:
        allowed = limit = expect.tube or 0.0
        deviation = peak(outside)
    else:
        deviation, limit = share_of(peak(outside), size + floor), allowed * (size + floor)
    passed = deviation <= allowed
    first = worst = None
    if not passed and measured.times is not None:
        first, worst = _places(outside, limit, measured.times)
    return Check(
        scene=scene,
        quantity=expect.quantity,
        unit=quantity.unit,
        fmu=peak(measured.value),
        against=_against(expect),
        reference=size,
        deviation=deviation,
        allowed=allowed,
        passed=passed,
        why=expect.why,
        at=at,
        first_time=first,
        worst_time=worst,
        tube=expect.tube,
    )


def _places(error: Array, allowed: float, times: Array) -> tuple[float, float]:
    """Return the times (s) at which errors (n,) first exceed what is allowed and are largest."""
    beyond = ~(error <= allowed)
    size = np.where(np.isfinite(error), error, np.inf)
    return float(times[np.argmax(beyond)]), float(times[np.argmax(size)])


def _distance(
    expect: ExpectTable, measured: Value, wanted: Value, smallest: float
) -> tuple[float | None, float | None]:
    """Return deviation and what is allowed; for a bound, by how much it is exceeded."""
    if isinstance(measured, str) or isinstance(wanted, str) or wanted is None or measured is None:
        return None, None
    difference = measured - wanted
    if expect.at_most is not None:
        difference = max(0.0, difference)
    if expect.at_least is not None:
        difference = max(0.0, -difference)
    return abs(difference), expect.absolute + expect.relative * max(abs(wanted), smallest)


def _verdict(
    measured: Value, wanted: Value, deviation: float | None, allowed: float | None
) -> bool:
    if deviation is None or allowed is None:
        return measured is not None and measured == wanted
    return deviation <= allowed


def _against(expect: ExpectTable) -> str:
    if expect.reference is not None:
        return expect.reference
    return {(True, False): "at most", (False, True): "at least"}.get(
        (expect.at_most is not None, expect.at_least is not None), "value"
    )
