"""The expected value of each quantity by each reference."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from slider_resonator.checks.measures.slow import slow_displacement
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.errors import SceneError
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
            return references.tube(expect.reference, expect.quantity, expect.tube)
        return EXPECTED[expect.quantity][expect.reference](references)
    except (ValueError, RuntimeError, ModuleNotFoundError) as error:
        where = f"{references.scene.source}: {expect.quantity}"
        raise SceneError(f"{where} cannot be compared: {error}") from error


def _signal(reference: str, output: str) -> Expected:
    return lambda references: references.signal(reference, output)


def _resolved(output: str) -> Mapping[str, Expected]:
    return {reference: _signal(reference, output) for reference in RESOLVED}


def _reversals(reference: str) -> Expected:
    return lambda references: references.trajectory(reference).reversals


EXPECTED: Mapping[str, Mapping[str, Expected]] = {
    "steady_velocity": {
        "located_events": lambda references: references.steady_velocity,
        "closed_form": lambda references: references.averaged_velocity,
        "averaged": lambda references: references.predicted_velocity,
    },
    "blocking_force": {
        "located_events": lambda references: references.blocking_force,
        "closed_form": lambda references: references.averaged_blocking_force,
        "averaged": lambda references: references.predicted_blocking_force,
    },
    "predicted_velocity": {
        "closed_form": lambda references: references.averaged_velocity,
        "averaged": lambda references: references.predicted_velocity,
    },
    "predicted_blocking_force": {
        "closed_form": lambda references: references.averaged_blocking_force,
        "averaged": lambda references: references.predicted_blocking_force,
    },
    "predicted_velocity_in_run": {
        "averaged": lambda references: references.predictions("predicted_velocity"),
    },
    "predicted_blocking_force_in_run": {
        "averaged": lambda references: references.predictions("predicted_blocking_force"),
    },
    "final_predicted_velocity": {
        "averaged": lambda references: references.at_the_end.predicted_velocity,
    },
    "final_predicted_blocking_force": {
        "averaged": lambda references: references.at_the_end.predicted_blocking_force,
    },
    "prediction_valid": {
        "averaged": lambda references: references.at_the_end.prediction_valid,
    },
    "position": {
        **_resolved("position"),
        "averaged": lambda references: references.averaged_motion.position,
    },
    "velocity": {
        **_resolved("velocity"),
        "averaged": lambda references: references.averaged_motion.velocity,
    },
    "resonator_displacement": _resolved("resonator_displacement"),
    "resonator_velocity": _resolved("resonator_velocity"),
    "normal_force": _resolved("normal_force"),
    "friction_force": _resolved("friction_force"),
    "contact_mode": _resolved("contact_mode"),
    "slow_displacement": {
        "located_events": lambda references: slow_displacement(
            references.times,
            references.signal("located_events", "position"),
            references.drive_period,
        ),
        "averaged": lambda references: slow_displacement(
            references.times, references.averaged_motion.position, references.drive_period
        ),
    },
    "mean_velocity": {
        "located_events": lambda references: references.mean_velocity,
        "averaged": lambda references: float(references.averaged_motion.mean_velocity[-1]),
    },
    "stick_fraction": {"located_events": lambda references: references.stick_fraction},
    "reversals": {reference: _reversals(reference) for reference in RESOLVED},
    "event_times": {
        "located_events": lambda references: references.event_times("located_events"),
        "taylor": lambda references: references.event_times("taylor"),
    },
    "last_event_time": {"located_events": lambda references: references.last_event_time},
    "ripple_amplitude": {"closed_form": lambda references: references.ripple_amplitude},
    "ripple_frequency": {"closed_form": lambda references: 1.0 / references.drive_period},
    "beat_frequency": {"closed_form": lambda references: references.difference_frequency},
}
"""Quantity to its references, by name, each with the function that gives its value."""
