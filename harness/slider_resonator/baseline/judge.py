"""The golden results of an FMU in a scene, and the changes since they were recorded."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from slider_resonator.checks.compare import Check, Comparison, Curves, compare, curves_of
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measuring import Measurement, measure
from slider_resonator.errors import NotApplicable, SceneError
from slider_resonator.scenes.scene import ScenePoint
from slider_resonator.scenes.vocabulary import QUANTITIES

MAX_POINTS = 48
"""Points that are kept of a run, evenly spaced over its communication points."""

SIGNALS = (
    *("position", "velocity", "resonator_displacement", "resonator_velocity"),
    *("normal_force", "friction_force", "contact_mode", "event_times"),
)
"""Signals kept at those points; `event_times` is the last event before each."""
OF_A_RUN = (
    *("mean_velocity", "stick_fraction", "reversals", "ripple_amplitude", "ripple_frequency"),
)
"""Numbers kept of a run as a whole, or of its last drive periods."""
OF_CONSTANT_INPUTS = (
    *("steady_status", "steady_velocity", "predicted_velocity"),
    *("blocking_status", "blocking_force", "predicted_blocking_force"),
)
"""Numbers and words found by shooting, and predicted by the FMU."""
NUMBERS_AND_WORDS = (*OF_CONSTANT_INPUTS, *OF_A_RUN)
"""All recorded quantities besides the signals, in the order of the files."""

Golden = Mapping[str, Measurement]
"""Quantity to its measurement; signals at few points."""


def measure_golden(fmu: FmuSide) -> Golden:
    """Measure all quantities that the scene allows: a ripple needs enough points per period.

    Raises FmuError and Refusal as the FMU does, NotApplicable where it cannot run the scene.
    """
    found = {}
    names = [*SIGNALS, *OF_A_RUN] if fmu.scene.stop_time is not None else []
    if all(signal.times == (0.0,) for signal in fmu.scene.signals.values()):
        names += OF_CONSTANT_INPUTS
    for name in names:
        try:
            measured = measure(name, fmu)
        except SceneError:
            continue
        if not measured.applicable:
            raise NotApplicable(measured.note)
        if name in SIGNALS:
            assert measured.times is not None
            last = len(measured.times) - 1
            kept = np.unique(np.rint(np.linspace(0, last, min(last + 1, MAX_POINTS))).astype(int))
            measured = replace(measured, value=measured.value[kept], times=measured.times[kept])
        found[name] = measured
    if "ripple_amplitude" not in found:  # too few points to see a ripple
        found.pop("ripple_frequency", None)
    return found


TOLERANCE = 1e-8
"""Relative change that passes: other platforms and compilers round differently."""
AGAINST = "baseline"


def compare_golden(
    point: ScenePoint, golden: Golden, now: Golden, tolerance: float
) -> Iterator[tuple[Check, Curves | None]]:
    """Compare every quantity that was recorded or exists now.

    Yield checks, and the curves of failed ones. Numbers may change by `tolerance` times their size,
    signals by that share of their peak, times of events by that share of a drive period; counts,
    words and contact modes must be equal. Raises SceneError where the run has other points.
    """
    for name in [one for one in (*NUMBERS_AND_WORDS, *SIGNALS) if one in {*golden, *now}]:
        recorded = golden.get(name, Measurement(None, "it was not recorded"))
        measured = now.get(name, Measurement(None, "the scene no longer allows it"))
        if name in SIGNALS and not _same_points(recorded, measured):
            raise SceneError(
                f"{point.scene.source}: the run of {point.scene.name} has other points than when "
                "it was recorded; record it again with --replace"
            )
        quantity, comparison = QUANTITIES[name], Comparison(name, AGAINST, "the recorded result")
        if quantity.in_periods:
            comparison = replace(comparison, tube=tolerance)
        elif not quantity.exact:
            comparison = replace(comparison, relative=tolerance)
        check = compare(comparison, measured, recorded.value, point)
        if measured.value is None and recorded.value is None:
            check = replace(check, passed=True)
        yield check, None if check.passed else curves_of(check, measured, recorded.value)


def _same_points(one: Measurement, other: Measurement) -> bool:
    if one.times is None or other.times is None:
        return False
    same = one.times.shape == other.times.shape
    return same and bool(np.allclose(one.times, other.times, rtol=1e-9, atol=0.0))
