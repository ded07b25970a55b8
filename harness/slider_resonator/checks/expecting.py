"""The expected value of each quantity by each reference, and those of scenes, computed ahead."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from functools import partial
from operator import attrgetter, methodcaller
from typing import Any

from slider_resonator.checks.period_means import (
    last_events,
    mean_velocities,
    reversal_counts,
    stick_fractions,
)
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.errors import HarnessError, SceneError
from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.fmu.isolation.tasks import LocalProcesses
from slider_resonator.scenes.scene import Scene, ScenePoint
from slider_resonator.scenes.schema import ExpectTable
from slider_resonator.scenes.vocabulary import QUANTITIES, RESOLVED

Expected = Callable[[ReferenceSide], Any]


def expected_value(expect: ExpectTable, references: ReferenceSide) -> Any:
    """Return the expected value: number, word, None, signal (n,) or tube.

    Raises SceneError where the reference does not apply to the scene.
    """
    if expect.reference is None:
        return next(v for v in (expect.value, expect.at_most, expect.at_least) if v is not None)
    try:
        if expect.tube is not None and not QUANTITIES[expect.quantity].in_periods:
            return references.by(expect.reference).tube(expect.quantity, expect.tube)
        return EXPECTED[expect.quantity][expect.reference](references)
    except (ValueError, RuntimeError, ModuleNotFoundError) as error:
        where = f"{references.scene.source}: {expect.quantity}"
        raise SceneError(f"{where} cannot be compared: {error}") from error


def _resolved(value: Expected, averaged: Expected | None = None) -> Mapping[str, Expected]:
    """Return a value by each reference with the fast motion, and that of averages if any."""

    def by(name: str) -> Expected:
        return lambda references: value(references.by(name))

    found = {name: by(name) for name in RESOLVED}
    return found if averaged is None else {**found, "averaged": averaged}


def _steady(located: str, predicted: str) -> Mapping[str, Expected]:
    """Return the references under constant inputs: what is located, the formula and averages."""
    return {
        "located_events": attrgetter(f"steady.{located}"),
        "closed_form": attrgetter(f"steady.of_paper.{predicted}"),
        "averaged": attrgetter(f"steady.{predicted}"),
    }


def _at_end(located: str, predicted: str) -> Mapping[str, Expected]:
    """Return the references for a prediction at the end of a run."""
    return {
        "located_events": attrgetter(f"steady_at_end.full_device.{located}"),
        "averaged": attrgetter(f"steady_at_end.{predicted}"),
    }


_VELOCITY, _FORCE = "predicted_velocity", "predicted_blocking_force"
_SIGNALS = (
    *("position", "velocity", "resonator_displacement", "resonator_velocity", "normal_force"),
)
_NOTHING = attrgetter("nothing")
EXPECTED: Mapping[str, Mapping[str, Expected]] = {
    "steady_velocity": _steady("steady_velocity", _VELOCITY),
    "blocking_force": _steady("blocking_force", _FORCE),
    "predicted_velocity": _steady("full_device.steady_velocity", _VELOCITY),
    "predicted_blocking_force": _steady("full_device.blocking_force", _FORCE),
    "predicted_velocity_in_run": {"averaged": methodcaller("predictions", _VELOCITY)},
    "predicted_blocking_force_in_run": {"averaged": methodcaller("predictions", _FORCE)},
    "final_predicted_velocity": _at_end("steady_velocity", _VELOCITY),
    "final_predicted_blocking_force": _at_end("blocking_force", _FORCE),
    "prediction_valid": {"averaged": attrgetter("steady_at_end.prediction_valid")},
    **{
        name: _resolved(methodcaller("signal", name), attrgetter(f"averaged_motion.{name}"))
        for name in _SIGNALS
    },
    **{
        name: _resolved(methodcaller("beside_events", name), attrgetter(f"averaged_motion.{name}"))
        for name in ("friction_force", "contact_mode")
    },
    "slow_displacement": {
        "located_events": lambda references: references.by("located_events").slow_displacement(),
        "averaged": methodcaller("slow_displacement", averaged=True),
    },
    "mean_velocity": _resolved(
        methodcaller("at_end", mean_velocities),
        lambda references: float(references.averaged_motion.mean_velocity[-1]),
    ),
    "mean_velocity_in_run": _resolved(
        methodcaller("in_run", mean_velocities), attrgetter("averaged_motion.mean_velocity")
    ),
    "stick_fraction": _resolved(methodcaller("at_end", stick_fractions)),
    "stick_fraction_in_run": _resolved(methodcaller("in_run", stick_fractions), _NOTHING),
    "friction_power": _resolved(attrgetter("friction_power")),
    "reversals": _resolved(methodcaller("at_end", reversal_counts)),
    "reversals_in_run": _resolved(methodcaller("in_run", reversal_counts), _NOTHING),
    "event_times": _resolved(methodcaller("in_run", last_events), _NOTHING),
    "last_event_time": _resolved(attrgetter("last_event_time")),
    "ripple_amplitude": {"closed_form": attrgetter("steady.ripple_amplitude")},
    "ripple_frequency": {"closed_form": lambda references: 1.0 / references.scene.drive_period},
    "beat_frequency": {"closed_form": attrgetter("steady.difference_frequency")},
}
"""Quantity to its references, by name, each with the function that gives its value."""


MIN_POINTS = 8
"""Fewest points for a further process: loading it takes as long as some references."""


class ExpectedValues(AbstractContextManager["ExpectedValues"]):
    """The expected values of scenes at some points, each computed once.

    Up to `jobs` processes compute them from the beginning on, in this order, with enough points for
    each. Use it in a `with` block, at the end of which they are ended.
    """

    def __init__(self, points: Sequence[ScenePoint], jobs: int = 1) -> None:
        count = max(1, min(jobs, len(points) // MIN_POINTS))
        self._processes = LocalProcesses(None, 1e6, count)  # s, more than any reference takes
        self._values = {
            point: self._processes.submit(partial(values_in, point.scene)) for point in points
        }

    def __exit__(self, *_: object) -> None:
        """End the processes, also in the middle of a reference."""
        self._processes.end()

    def at(self, point: ScenePoint) -> list[Any]:
        """Wait for a value for each expectation, or the SceneError where there is none.

        Raises HarnessError where a process that computes them has ended.
        """
        try:
            values: list[Any] = self._values[point].result().result()
        except FmuDied as error:
            raise HarnessError(
                f"scene {point.scene.name}: the process that computes its references has ended: "
                f"{error}"
            ) from error
        return values


def values_in(scene: Scene, _: None = None) -> list[Any]:
    """Return a value for each expectation of a scene, or the SceneError where there is none.

    A process of its own runs it as a task, without an FMU.
    """
    references = ReferenceSide(scene)
    values: list[Any] = []
    for expect in scene.expect:
        try:
            values.append(expected_value(expect, references))
        except SceneError as error:
            values.append(error)
    return values
