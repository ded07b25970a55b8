"""Compare the measurement of one quantity with its expected value; signals for reports."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array, beyond_rounding, is_same
from slider_resonator.checks.measures import Tube, peak, share_of
from slider_resonator.checks.measuring import Measurement
from slider_resonator.checks.natural_scale import smallest_reference
from slider_resonator.device.interface import VARIABLES
from slider_resonator.scenes.scene import Scene, ScenePoint
from slider_resonator.scenes.schema import ExpectTable
from slider_resonator.scenes.vocabulary import QUANTITIES

Value = float | str | None

AT_MOST = "at most"
AT_LEAST = "at least"


@dataclass(frozen=True)
class Check:
    """One comparison with its verdict.

    For a signal, `fmu` and `reference` are peaks, and `deviation` and `allowed` shares of `scale`,
    in its unit: the reference's peak, or what a reference near zero counts as. For a number, and
    for times of events, they carry a unit and `scale` is None. `against` is the name of the
    reference, "value", or for a bound `AT_MOST` or `AT_LEAST`. `at` is what a sweep varies. A
    signal that fails is beyond what is allowed from `first_time` (s) on and farthest at
    `worst_time` (s), where it is `fmu_then` and the reference `reference_then`. A deviation is
    counted from the edge of a tube, where there is one; `tube` is its half width in drive periods.
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
    fmu_then: float | None = None
    reference_then: float | None = None
    tube: float | None = None
    scale: float | None = None

    @property
    def severity(self) -> float:
        """Deviation over the allowed deviation."""
        if self.allowed and self.deviation is not None and isfinite(self.deviation):
            return self.deviation / self.allowed
        return 0.0 if self.passed else float("inf")


@dataclass(frozen=True)
class Comparison:
    """What a quantity is compared with, the reason, and the tolerance.

    A deviation of `absolute + relative * |reference|`, in the unit of the quantity, is allowed.
    Without an `absolute`, be it 0, a reference counts as no smaller than a share of its natural
    scale. For a signal `relative` is a share of the reference's peak, and `absolute` beside it is
    for a reference near zero. `tube` is the half width of a tube in drive periods; of a quantity
    measured in drive periods it is the tolerance. A value that is on neither side fails unless it
    `may_lack`.
    """

    quantity: str
    against: str
    why: str
    absolute: float | None = None
    relative: float = 0.0
    tube: float | None = None
    may_lack: bool = False

    @classmethod
    def of(cls, expect: ExpectTable) -> "Comparison":
        """Return the comparison of an expectation in a scene file."""
        bounds = {AT_MOST: expect.at_most, AT_LEAST: expect.at_least}
        bound = next((name for name, value in bounds.items() if value is not None), "value")
        absolute = expect.absolute if "absolute" in expect.model_fields_set else None
        tolerance = (absolute, expect.relative, expect.tube)
        return cls(expect.quantity, expect.reference or bound, expect.why, *tolerance)


def compare(
    comparison: Comparison, measured: Measurement, expected: Any, point: ScenePoint
) -> Check:
    """Compare a measurement with the expected value: number, word, None, signal (n,) or a tube.

    A value that does not exist fails, as does one that is not finite.
    """
    quantity = QUANTITIES[comparison.quantity]
    floor = 0.0
    if comparison.absolute is None:
        floor = smallest_reference(comparison.quantity, point.scene.device)
    got = measured.value
    if quantity.kind == "signal":
        difference = _difference_of_signals(comparison, measured, expected, floor, point.scene)
    elif isinstance(got, str | None) or isinstance(expected, str | None):
        passed = got == expected and (got is not None or comparison.may_lack)
        difference = {"deviation": None, "allowed": None, "passed": passed}
    else:
        off = got - expected  # a bound counts by how much it is exceeded; NaN stays NaN
        excess = {AT_MOST: max(off, 0.0), AT_LEAST: max(-off, 0.0)}
        deviation = 0.0 if is_same(got, expected) else excess.get(comparison.against, abs(off))
        allowed = (comparison.absolute or 0.0) + comparison.relative * max(abs(expected), floor)
        passed = deviation <= allowed
        difference = {"deviation": deviation, "allowed": allowed, "passed": passed}
    return Check(
        scene=point.scene.name,
        quantity=comparison.quantity,
        unit=quantity.unit,
        against=comparison.against,
        why=comparison.why,
        note=measured.note,
        at=point.at,
        tube=comparison.tube,
        **{"fmu": got, "reference": expected, **difference},
    )


def _difference_of_signals(
    comparison: Comparison,
    measured: Measurement,
    expected: Array | Tube,
    floor: float,
    scene: Scene,
) -> dict[str, Any]:
    """Return the fields of a check of two signals; a value that is not finite fails."""
    quantity = QUANTITIES[comparison.quantity]
    tube = expected if isinstance(expected, Tube) else Tube(expected, expected, expected)
    size = peak(tube.middle)
    rounded = tube.middle
    if not (size or floor or comparison.absolute) and comparison.quantity in VARIABLES:
        # Where it is 0 in a device without a scale of it, an FMU may round a usual value.
        usual = VARIABLES[comparison.quantity].nominal or 0.0
        rounded = np.full_like(tube.middle, usual)
    outside = beyond_rounding(tube.outside(measured.value), rounded)
    allowed, scale = comparison.relative, None
    if quantity.exact:
        limit = 0.5  # of integers; an error that is not finite counts as a difference
        deviation = float(np.mean(~(outside <= limit)))
    elif quantity.in_periods:
        allowed = limit = comparison.tube or 0.0
        deviation = peak(outside)
    else:
        near_zero = comparison.absolute / allowed if comparison.absolute else max(0.0, floor - size)
        scale = size + near_zero
        if scene.start_time:
            # Such a clock is coarse: steps that an FMU cuts in two end beside a communication
            # point by a unit of it, each of them.
            unit = float(np.spacing(abs(scene.start_time)))
            allowed += len(scene.schedule().times) * scene.device.drive_frequency * unit
        deviation, limit = share_of(peak(outside), scale), allowed * scale
    passed = deviation <= allowed
    difference = {"deviation": deviation, "allowed": allowed, "passed": passed, "scale": scale}
    if not passed and measured.times is not None:
        worst = np.argmax(np.where(np.isfinite(outside), outside, np.inf))
        difference |= {
            "first_time": float(measured.times[np.argmax(~(outside <= limit))]),
            "worst_time": float(measured.times[worst]),
            "fmu_then": float(measured.value[worst]),
            "reference_then": float(tube.middle[worst]),
        }
    return {"fmu": peak(measured.value), "reference": size, **difference}


SLOW = ("mean_velocity_in_run", "slow_displacement", "position")
"""Signals that show a run, the first that a scene expects."""
FAST = ("velocity", "resonator_velocity", "resonator_displacement", "friction_force")
"""Signals of which the last points are shown where there is no slow one."""
MAX_POINTS = 400


@dataclass(frozen=True)
class Curves:
    """The signals behind a check: `fmu` and `reference` at `times` (s), all shape (n,)."""

    check: Check
    times: Array
    fmu: Array
    reference: Array

    def part(self, kept: slice | NDArray[np.intp]) -> "Curves":
        """Return some of the points, as copies."""
        signals = (self.times, self.fmu, self.reference)
        return Curves(self.check, *(np.array(signal[kept]) for signal in signals))

    def thinned(self) -> "Curves":
        """Return evenly spaced points, at most `MAX_POINTS`, and the one that is farthest off."""
        count = len(self.times)
        if count <= MAX_POINTS:
            return self
        even = np.linspace(0, count - 1, MAX_POINTS).round().astype(np.intp)
        off = np.nan_to_num(np.abs(self.fmu - self.reference), nan=np.inf)
        return self.part(np.union1d(even, np.argmax(off)))


def curves_of(check: Check, measured: Measurement, expected: Any) -> Curves | None:
    """Return the signals behind a check, None where it has none or no reference for it."""
    reference = expected.middle if isinstance(expected, Tube) else expected
    if measured.times is None or np.shape(reference) != np.shape(measured.value):
        return None
    return Curves(check, measured.times, measured.value, reference)


def overview_of(found: Sequence[Curves]) -> Curves | None:
    """Return the signal that shows a scene, thinned, or the end of a fast one; None without one."""
    by_quantity = {curves.check.quantity: curves for curves in reversed(found)}
    for name in (*SLOW, *FAST):
        if name in by_quantity:
            shown = by_quantity[name]
            return shown.part(slice(-MAX_POINTS, None)) if name in FAST else shown.thinned()
    return None
