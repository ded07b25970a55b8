"""Run an FMU over scenes up to the first check that rejects it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.compare import Check, Comparison, compare
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measure_points import measure_points
from slider_resonator.checks.measures.deviation import peak
from slider_resonator.checks.measuring import Measurement, measure_all
from slider_resonator.checks.tolerance import Tolerance
from slider_resonator.checks.verdict import place, sentence
from slider_resonator.errors import NotApplicable
from slider_resonator.scenes.scene import ScenePoint

TRAJECTORY_OUTPUTS: Mapping[str, float | None] = {
    "mean_velocity": None,
    "stick_fraction": 1e-9,
    "reversals": 0.0,
    "last_event_time": 1e-9,
    "steady_velocity": None,
    "blocking_force": None,
}
"""Outputs that scenes check at one time only, with the allowed change in their unit; None stands
for a share of the peak."""

Outputs = Mapping[str, NDArray[np.float64]]
"""Output to its values at the communication points, shape (n,)."""

_ROUNDING = 1e-12
"""Differences that are rounding, m/s or N."""


@dataclass(frozen=True, eq=False)
class ExpectedPoint(ScenePoint):
    """A scene point with an expected value for each of its expectations.

    Where there are `outputs`, they are expected as well: at each communication point, up to
    `share` of an output's peak.
    """

    expected: tuple[Any, ...] = ()
    outputs: Outputs = field(default_factory=dict)
    share: float = 0.0

    @property
    def name(self) -> str:
        """The scene and the point of its sweep."""
        return f"{self.scene.name}{place(self.at, ' at ')}"


@dataclass(frozen=True)
class Observed:
    """The results of an FMU at a point: a measurement for each expectation, other outputs."""

    measured: tuple[Measurement, ...]
    outputs: Outputs


@dataclass(frozen=True)
class Rejection:
    """The rejection of an FMU: scene, quantity and reason in a sentence.

    Without a quantity it could not be run there; without a scene, nowhere.
    """

    scene: str
    quantity: str
    reason: str


def trial(fmu: Path, points: Sequence[ExpectedPoint], time_limit: float) -> Rejection | None:
    """Judge the points one after the other, in a process that may take `time_limit` (s) for each.

    Where the FMU crashes, hangs or refuses, that is a rejection as well.
    """
    measure = observe if any(point.outputs for point in points) else observe_expected
    with closing(measure_points(fmu, points, measure, time_limit)) as finished:
        for one in finished:
            point = one.item
            if isinstance(one.error, NotApplicable):
                continue
            if one.error is not None or point is None:
                return Rejection(point.name if point else "", "", str(one.error))
            rejection = judge(point, one.result)
            if rejection is not None:
                return rejection
    return None


def judge(point: ExpectedPoint, seen: Observed) -> Rejection | None:
    """Return the first check of the results of an FMU at a point that fails."""
    for check in _checks(point, seen):
        if not check.passed:
            return Rejection(point.name, check.quantity, sentence(check))
    return None


def observe(fmu: FmuSide) -> Observed:
    """Measure what the scene expects, and record the other outputs."""
    whole = FmuSide(fmu.instance, fmu.scene, predictions=True)
    return Observed(measure_all(whole), {name: whole.record[name] for name in TRAJECTORY_OUTPUTS})


def observe_expected(fmu: FmuSide) -> Observed:
    """Measure what the scene expects."""
    return Observed(measure_all(fmu), {})


def _checks(point: ExpectedPoint, seen: Observed) -> Iterator[Check]:
    """Yield the checks of all values that exist in the FMU, or should."""
    for expect, measured, expected in zip(
        point.scene.expect, seen.measured, point.expected, strict=True
    ):
        if measured.applicable and (measured.value is not None or expected is not None):
            yield compare(Comparison.of(expect), measured, expected, point)
    for name, values in point.outputs.items():
        allowed = TRAJECTORY_OUTPUTS[name]
        if allowed is None:
            allowed = point.share * peak(values) + _ROUNDING
        difference = np.abs(seen.outputs[name] - values)
        worst = int(np.argmax(np.where(np.isnan(difference), np.inf, difference)))
        comparison = Comparison(name, "original", Tolerance(absolute=allowed), "as the original")
        measured = Measurement(float(seen.outputs[name][worst]))
        yield compare(comparison, measured, float(values[worst]), point)
