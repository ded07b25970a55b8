"""Judging one expectation: what the FMU gives, what it should be, whether that is near enough."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from harness.errors import SceneError
from harness.fmu_side import FmuSide
from harness.measures.deviation import peak
from harness.quantities import QUANTITIES, Quantity
from harness.reference_side import ReferenceSide
from harness.scene_model import ExpectTable

Value = float | str | None


@dataclass(frozen=True)
class Check:
    """One expectation with its verdict.

    For a signal, `fmu` and `reference` are peaks, and `deviation` and `allowed` shares of the
    reference's peak; for a number they carry its unit. `at` says what a sweep has varied.
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

    @property
    def severity(self) -> float:
        """Deviation in units of what is allowed: the larger, the worse."""
        if self.deviation is None or not isfinite(self.deviation):
            return 0.0 if self.passed else float("inf")
        if self.allowed:
            return self.deviation / self.allowed
        return 0.0 if self.passed else float("inf")


def check(
    expect: ExpectTable, fmu: FmuSide, reference: ReferenceSide, at: Mapping[str, float]
) -> Check:
    """Measure, compare and judge; SceneError when the comparison itself makes no sense."""
    quantity = QUANTITIES[expect.quantity]
    try:
        measured = quantity.measure(fmu)
        if quantity.kind == "signal":
            return _signal_check(expect, quantity, measured, fmu, reference, at)
        if expect.reference is not None:
            wanted = quantity.references[expect.reference](reference)
        else:
            wanted = next(
                v for v in (expect.value, expect.at_most, expect.at_least) if v is not None
            )
    except (ValueError, RuntimeError, ModuleNotFoundError) as error:
        where = f"{fmu.scene.source}: {expect.quantity}"
        raise SceneError(f"{where} cannot be compared{_at(at)}: {error}") from error
    deviation, allowed = _distance(expect, measured, wanted)
    return Check(
        scene=fmu.scene.name,
        quantity=expect.quantity,
        unit=quantity.unit,
        fmu=measured,
        against=_against(expect),
        reference=wanted,
        deviation=deviation,
        allowed=allowed,
        passed=_verdict(measured, wanted, deviation, allowed),
        why=expect.why,
        note=_note(expect, measured, fmu),
        at=at,
    )


def _signal_check(
    expect: ExpectTable,
    quantity: Quantity,
    measured: NDArray[np.float64],
    fmu: FmuSide,
    reference: ReferenceSide,
    at: Mapping[str, float],
) -> Check:
    """Compare two signals; a value that is not finite fails."""
    wanted = quantity.references[str(expect.reference)](reference)
    deviation = quantity.deviation(measured, wanted)
    return Check(
        scene=fmu.scene.name,
        quantity=expect.quantity,
        unit=quantity.unit,
        fmu=peak(measured),
        against=_against(expect),
        reference=peak(wanted),
        deviation=deviation,
        allowed=expect.relative,
        passed=deviation <= expect.relative,
        why=expect.why,
        at=at,
    )


def _distance(
    expect: ExpectTable, measured: Value, wanted: Value
) -> tuple[float | None, float | None]:
    """Return deviation and what is allowed; for a bound, by how much it is exceeded."""
    if isinstance(measured, str) or isinstance(wanted, str) or wanted is None or measured is None:
        return None, None
    difference = measured - wanted
    if expect.at_most is not None:
        difference = max(0.0, difference)
    if expect.at_least is not None:
        difference = max(0.0, -difference)
    return abs(difference), expect.absolute + expect.relative * abs(wanted)


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


def _at(at: Mapping[str, float]) -> str:
    return "".join(f" at {name} = {value:g}" for name, value in at.items())
