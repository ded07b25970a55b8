"""Expected values of scenes, computed ahead in processes of their own."""

import os
from collections.abc import Sequence
from functools import partial
from typing import Any

from slider_resonator.checks.expecting import expected_value
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.errors import HarnessError, SceneError
from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.fmu.isolation.tasks import LocalProcesses
from slider_resonator.scenes.scene import Scene, ScenePoint

MIN_POINTS = 8
"""Fewest points for a further process: loading it takes as long as some references."""
TIME_LIMIT = 1e6
"""Time limit (s) of a reference: none."""
PRIORITY = 5
"""An FMU of Python takes longer than its references: it comes first."""


class ExpectedValues:
    """The expected values of scenes at some points, each computed once.

    Up to `jobs` processes compute them from the beginning on, in this order, with enough points for
    each. Use it in a `with` block, at the end of which they are ended.
    """

    def __init__(self, points: Sequence[ScenePoint], jobs: int = 1) -> None:
        count = max(1, min(jobs, len(points) // MIN_POINTS))
        self._processes = LocalProcesses(None, TIME_LIMIT, count)
        self._values = {
            point: self._processes.submit(partial(_values_ahead, scene=point.scene))
            for point in points
        }

    def __enter__(self) -> "ExpectedValues":
        """Return this."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the processes, also in the middle of a reference."""
        self._processes.end()

    def at(self, point: ScenePoint) -> list[Any]:
        """Wait for a value for each expectation, or the SceneError where there is none.

        Raises HarnessError where a process that computes them has ended.
        """
        outcome = self._values[point].result()
        if isinstance(outcome.error, FmuDied):
            reason = str(outcome.error).replace("the FMU", "it")
            raise HarnessError(
                f"scene {point.scene.name}: the process that computes its references has ended: "
                f"{reason}"
            )
        if outcome.error is not None:
            raise outcome.error
        values: list[Any] = outcome.value
        return values


def values_in(scene: Scene) -> list[Any]:
    """Return a value for each expectation of a scene, or the SceneError where there is none."""
    references = ReferenceSide(scene)
    values: list[Any] = []
    for expect in scene.expect:
        try:
            values.append(expected_value(expect, references))
        except SceneError as error:
            values.append(error)
    return values


def _values_ahead(_: None, scene: Scene) -> list[Any]:
    """Return the same in a process of its own."""
    if hasattr(os, "nice"):
        os.nice(max(0, PRIORITY - os.nice(0)))
    return values_in(scene)
