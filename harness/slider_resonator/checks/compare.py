"""Judging one expectation: what the FMU gives, what it should be, whether that is near enough."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measures.deviation import mismatch_share, peak, share_of
from slider_resonator.checks.measures.frequency import NoOscillation
from slider_resonator.checks.measures.tube import Tube, no_tube
from slider_resonator.checks.quantities import QUANTITIES, Quantity
from slider_resonator.errors import SceneError

if TYPE_CHECKING:
    # The process that an FMU is measured in judges nothing, and needs no references.
    from slider_resonator.checks.reference_side import ReferenceSide
    from slider_resonator.scenes.schema import ExpectTable

Array = NDArray[np.float64]
Value = float | str | None


@dataclass(frozen=True)
class Measurement:
    """What an FMU gives for an expectation: number, word, None or a signal (n,).

    `note` says why there is None; a signal has the `times` (s), shape (n,), of its points.
    """

    value: Any
    note: str = ""
    times: Array | None = None


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


def measure(expect: ExpectTable, fmu: FmuSide) -> Measurement:
    """Measure what is expected of the FMU; SceneError when the scene does not allow it."""
    quantity = QUANTITIES[expect.quantity]
    try:
        value = quantity.measure(fmu)
    except (NoOscillation, np.linalg.LinAlgError, ArithmeticError) as error:
        return Measurement(None, f"{expect.quantity} does not exist: {error}")
    except (ValueError, RuntimeError) as error:
        where = f"{fmu.scene.source}: {expect.quantity}"
        raise SceneError(f"{where} cannot be measured: {error}") from error
    if quantity.kind == "signal":
        return Measurement(value, times=fmu.record.times[-len(value) :])
    return Measurement(value, _note(expect, value, fmu))


def measure_all(fmu: FmuSide) -> tuple[Measurement, ...]:
    """Measure everything that the scene expects of the FMU; SceneError as `measure` raises it."""
    return tuple(measure(expect, fmu) for expect in fmu.scene.expect)


def wanted(expect: ExpectTable, reference: ReferenceSide) -> Any:
    """Return what the reference says: number, word, None, signal (n,) or a tube around one.

    Raises SceneError when the comparison makes no sense.
    """
    if expect.reference is None:
        return next(v for v in (expect.value, expect.at_most, expect.at_least) if v is not None)
    quantity = QUANTITIES[expect.quantity]
    try:
        if expect.tube is not None and not quantity.in_periods:
            return reference.tube(expect.reference, expect.quantity, expect.tube)
        return quantity.references[expect.reference](reference)
    except (ValueError, RuntimeError, ModuleNotFoundError) as error:
        where = f"{reference.scene.source}: {expect.quantity}"
        raise SceneError(f"{where} cannot be compared: {error}") from error


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


def _note(expect: ExpectTable, measured: Value, fmu: FmuSide) -> str:
    """Say why there is nothing to compare."""
    if measured is not None:
        return ""
    return fmu.steady.reason if expect.quantity == "steady_velocity" else fmu.blocking.reason
