"""What has changed since golden results were recorded, as checks like those of `validate`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from slider_resonator.checks.compare import Check, check
from slider_resonator.checks.measuring import Measurement
from slider_resonator.checks.natural_scale import smallest_reference
from slider_resonator.errors import SceneError
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.schema import ExpectTable
from slider_resonator.scenes.vocabulary import QUANTITIES
from slider_resonator.trials.baseline.golden import SIGNALS, Golden, order

TOLERANCE = 1e-8
"""Relative change that counts as none: other platforms and compilers round differently."""
AGAINST = "baseline"


@dataclass(frozen=True)
class Compared:
    """A verdict with what it was made from."""

    check: Check
    measured: Measurement
    golden: Any


def compared(
    scene: Scene, at: Mapping[str, float], golden: Golden, now: Golden, tolerance: float
) -> Iterator[Compared]:
    """Compare every quantity that was recorded, or is there now.

    Numbers may change by `tolerance` times their size, signals by that share of their peak, times
    of events by that share of a drive period; counts, words and contact modes must be equal. Raises
    SceneError where the run has other points.
    """
    for name in sorted({*golden, *now}, key=order):
        wanted = golden.get(name, Measurement(None, "it was not recorded"))
        measured = now.get(name, Measurement(None, "the scene does not allow it any more"))
        if name in SIGNALS and not _same_points(wanted, measured):
            raise SceneError(
                f"{scene.source}: the run of {scene.name} has other points than when it was "
                "recorded; record it again with --replace"
            )
        expect = _expectation(name, tolerance)
        smallest = smallest_reference(name, scene.device)
        verdict = check(expect, measured, wanted.value, scene.name, at, smallest)
        if measured.value is None and wanted.value is None:
            verdict = replace(verdict, passed=True)
        yield Compared(replace(verdict, against=AGAINST), measured, wanted.value)


def _expectation(name: str, tolerance: float) -> ExpectTable:
    quantity = QUANTITIES[name]
    given: dict[str, Any] = {"relative": tolerance}
    if quantity.exact:
        given = {}
    elif quantity.in_periods:
        given = {"tube": tolerance}
    return ExpectTable.model_construct(
        quantity=name, reference=AGAINST, why="it was so when it was recorded", **given
    )


def _same_points(one: Measurement, other: Measurement) -> bool:
    if one.times is None or other.times is None:
        return False
    same = one.times.shape == other.times.shape
    return same and bool(np.allclose(one.times, other.times, rtol=1e-9, atol=0.0))
