"""The golden results of an FMU in a scene, and the changes since they were recorded."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from slider_resonator.checks.compare import Comparison
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measuring import Measurement, measure
from slider_resonator.checks.validate import Judged
from slider_resonator.errors import SceneError
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

THE_RUN = "the run"
"""In place of all of them where they do not apply to an FMU."""

Golden = Mapping[str, Measurement]
"""Quantity to its measurement; signals at few points."""


def measure_golden(fmu: FmuSide) -> Golden:
    """Measure all quantities that the scene allows: a ripple needs enough points per period.

    There is `THE_RUN` alone where the FMU cannot run the scene. Raises FmuError and Refusal as it
    does.
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
            return {THE_RUN: measured}
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
) -> Iterator[Judged]:
    """Yield every quantity that was recorded or exists now, and how it is compared.

    Numbers may change by `tolerance` times their size, signals by that share of their peak, times
    of events by that share of a drive period; counts, words and contact modes must be equal. Raises
    SceneError where the run has other points.
    """
    for name in [one for one in (*NUMBERS_AND_WORDS, *SIGNALS) if one in {*golden, *now}]:
        recorded = golden.get(name, Measurement(None, "it was not recorded"))
        measured = now.get(name, Measurement(None, "the scene no longer allows it"))
        if name in SIGNALS and not _same_points(recorded, measured):
            raise SceneError(
                f"{point.scene.source}: the run of {point.scene.name} has other points than when "
                "it was recorded; record it again with --replace"
            )
        quantity = QUANTITIES[name]
        comparison = Comparison(name, AGAINST, "the recorded result", may_lack=True)
        if quantity.in_periods:
            comparison = replace(comparison, tube=tolerance)
        elif not quantity.exact:
            comparison = replace(comparison, relative=tolerance)
        yield comparison, measured, recorded.value


def _same_points(one: Measurement, other: Measurement) -> bool:
    if one.times is None or other.times is None:
        return False
    same = one.times.shape == other.times.shape
    return same and bool(np.allclose(one.times, other.times, rtol=1e-9, atol=0.0))
