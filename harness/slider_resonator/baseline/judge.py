"""The changes since golden results were recorded, as checks like those of `validate`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from slider_resonator.baseline.golden import SIGNALS, Golden, order
from slider_resonator.checks.compare import Check, Comparison, compare
from slider_resonator.checks.measuring import Measurement
from slider_resonator.checks.tolerance import Tolerance
from slider_resonator.checks.validate import Curves, curves_of
from slider_resonator.errors import SceneError
from slider_resonator.scenes.scene import ScenePoint
from slider_resonator.scenes.vocabulary import QUANTITIES

TOLERANCE = 1e-8
"""Relative change that passes: other platforms and compilers round differently."""
AGAINST = "baseline"


def compare_golden(
    point: ScenePoint, golden: Golden, now: Golden, tolerance: float
) -> Iterator[tuple[Check, Curves | None]]:
    """Compare every quantity that was recorded or exists now; yield checks and their curves.

    Numbers may change by `tolerance` times their size, signals by that share of their peak, times
    of events by that share of a drive period; counts, words and contact modes must be equal. Raises
    SceneError where the run has other points.
    """
    for name in sorted({*golden, *now}, key=order):
        recorded = golden.get(name, Measurement(None, "it was not recorded"))
        measured = now.get(name, Measurement(None, "the scene no longer allows it"))
        if name in SIGNALS and not _same_points(recorded, measured):
            raise SceneError(
                f"{point.scene.source}: the run of {point.scene.name} has other points than when "
                "it was recorded; record it again with --replace"
            )
        check = compare(_comparison(name, tolerance), measured, recorded.value, point)
        if measured.value is None and recorded.value is None:
            check = replace(check, passed=True)
        yield check, curves_of(check, measured, recorded.value)


def _comparison(name: str, share: float) -> Comparison:
    quantity = QUANTITIES[name]
    tolerance = Tolerance(relative=share)
    if quantity.exact:
        tolerance = Tolerance()
    elif quantity.in_periods:
        tolerance = Tolerance(tube=share)
    return Comparison(name, AGAINST, tolerance, "the recorded result")


def _same_points(one: Measurement, other: Measurement) -> bool:
    if one.times is None or other.times is None:
        return False
    same = one.times.shape == other.times.shape
    return same and bool(np.allclose(one.times, other.times, rtol=1e-9, atol=0.0))
