"""The quantities that a scene can expect something of: how each is measured and referred to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.measures.frequency import dominant_frequency
from slider_resonator.checks.measures.ripple import ripple_amplitude
from slider_resonator.checks.measures.slow import slow_displacement

if TYPE_CHECKING:
    from slider_resonator.checks.fmu_side import FmuSide
    from slider_resonator.checks.reference_side import ReferenceSide

Array = NDArray[np.float64]
Kind = Literal["number", "word", "signal"]


@dataclass(frozen=True)
class Quantity:
    """A quantity: number, word or signal.

    `measure` takes it from the FMU, `references` from what each named reference knows. A number or
    word that is None does not exist. Of an `exact` quantity, a count or a word, equality can be
    expected without naming a tolerance. The `referees` know a signal at any time, so that there can
    be a tube around it. A signal `in_periods` is judged by its deviation in drive periods.
    """

    kind: Kind
    unit: str
    meaning: str
    measure: Callable[[FmuSide], Any]
    references: Mapping[str, Callable[[ReferenceSide], Any]] = field(default_factory=dict)
    needs_run: bool = False
    exact: bool = False
    referees: tuple[str, ...] = ()
    in_periods: bool = False

    @property
    def relative_to_peak(self) -> bool:
        """Whether a deviation is a share of the reference's peak."""
        return self.kind == "signal" and not self.in_periods


def _signal(name: str, unit: str, meaning: str, *, averaged: bool = False) -> Quantity:
    """Return an output that is compared point by point, also with averaged motion if it has it."""
    references: dict[str, Callable[[ReferenceSide], Any]] = {
        "located_events": lambda reference: reference.signal("located_events", name),
        "taylor": lambda reference: reference.signal("taylor", name),
        "bristle_state": lambda reference: reference.signal("bristle_state", name),
    }
    referees = () if name == "contact_mode" else tuple(references)
    if averaged:
        references["averaged"] = lambda reference: getattr(reference.averaged_motion, name)
    return Quantity(
        "signal",
        unit,
        meaning,
        lambda fmu: fmu.record[name],
        references,
        needs_run=True,
        exact=name == "contact_mode",
        referees=referees,
    )


def _later_half(times: Array, signal: Array) -> tuple[Array, Array]:
    half = len(times) // 2
    return times[half:], signal[half:]


QUANTITIES: Mapping[str, Quantity] = {
    "steady_velocity": Quantity(
        "number",
        "m/s",
        "mean velocity of the steady motion, by shooting",
        lambda fmu: fmu.steady.steady_velocity,
        {
            "located_events": lambda reference: reference.steady_velocity,
            "closed_form": lambda reference: reference.averaged_velocity,
            "averaged": lambda reference: reference.predicted_velocity,
        },
    ),
    "steady_status": Quantity(
        "word",
        "",
        "outcome of the search for steady motion",
        lambda fmu: fmu.steady.status,
        exact=True,
    ),
    "steady_periods": Quantity(
        "number",
        "1",
        "drive periods simulated for it",
        lambda fmu: fmu.steady.periods,
        exact=True,
    ),
    "blocking_force": Quantity(
        "number",
        "N",
        "load under which the mean velocity is zero, by shooting",
        lambda fmu: fmu.blocking.blocking_force,
        {
            "located_events": lambda reference: reference.blocking_force,
            "closed_form": lambda reference: reference.averaged_blocking_force,
            "averaged": lambda reference: reference.predicted_blocking_force,
        },
    ),
    "blocking_status": Quantity(
        "word",
        "",
        "outcome of the search for the blocking force",
        lambda fmu: fmu.blocking.status,
        exact=True,
    ),
    "blocking_periods": Quantity(
        "number",
        "1",
        "drive periods simulated for it",
        lambda fmu: fmu.blocking.periods,
        exact=True,
    ),
    "predicted_velocity": Quantity(
        "number",
        "m/s",
        "the FMU's output steady_velocity",
        lambda fmu: fmu.steady.predicted,
        {
            "closed_form": lambda reference: reference.averaged_velocity,
            "averaged": lambda reference: reference.predicted_velocity,
        },
    ),
    "predicted_blocking_force": Quantity(
        "number",
        "N",
        "the FMU's output blocking_force",
        lambda fmu: fmu.blocking.predicted,
        {
            "closed_form": lambda reference: reference.averaged_blocking_force,
            "averaged": lambda reference: reference.predicted_blocking_force,
        },
    ),
    "final_predicted_velocity": Quantity(
        "number",
        "m/s",
        "the FMU's output steady_velocity at the end of the run",
        lambda fmu: fmu.record.final("steady_velocity"),
        {"averaged": lambda reference: reference.at_the_end.predicted_velocity},
        needs_run=True,
    ),
    "final_predicted_blocking_force": Quantity(
        "number",
        "N",
        "the FMU's output blocking_force at the end of the run",
        lambda fmu: fmu.record.final("blocking_force"),
        {"averaged": lambda reference: reference.at_the_end.predicted_blocking_force},
        needs_run=True,
    ),
    "position": _signal("position", "m", "slider position", averaged=True),
    "velocity": _signal("velocity", "m/s", "slider velocity", averaged=True),
    "resonator_displacement": _signal("resonator_displacement", "m", "relative displacement"),
    "resonator_velocity": _signal("resonator_velocity", "m/s", "relative velocity"),
    "normal_force": _signal("normal_force", "N", "normal force of a face"),
    "friction_force": _signal("friction_force", "N", "friction force of all faces"),
    "contact_mode": _signal("contact_mode", "1", "share of points in another contact mode"),
    "slow_displacement": Quantity(
        "signal",
        "m",
        "position averaged over a drive period",
        lambda fmu: slow_displacement(fmu.record.times, fmu.record["position"], fmu.drive_period),
        {
            "located_events": lambda reference: slow_displacement(
                reference.times,
                reference.signal("located_events", "position"),
                reference.drive_period,
            ),
            "averaged": lambda reference: slow_displacement(
                reference.times, reference.averaged_motion.position, reference.drive_period
            ),
        },
        needs_run=True,
    ),
    "mean_velocity": Quantity(
        "number",
        "m/s",
        "mean velocity over the last whole drive period of the run",
        lambda fmu: fmu.record.final("mean_velocity"),
        {
            "located_events": lambda reference: reference.mean_velocity,
            "averaged": lambda reference: float(reference.averaged_motion.mean_velocity[-1]),
        },
        needs_run=True,
    ),
    "stick_fraction": Quantity(
        "number",
        "1",
        "share of the last whole drive period of the run spent sticking",
        lambda fmu: fmu.record.final("stick_fraction"),
        {"located_events": lambda reference: reference.stick_fraction},
        needs_run=True,
    ),
    "reversals": Quantity(
        "number",
        "1",
        "reversals of sliding during the run",
        lambda fmu: fmu.record.final("reversals"),
        {
            "located_events": lambda reference: reference.trajectory("located_events").reversals,
            "taylor": lambda reference: reference.trajectory("taylor").reversals,
            "bristle_state": lambda reference: reference.trajectory("bristle_state").reversals,
        },
        needs_run=True,
        exact=True,
    ),
    "event_times": Quantity(
        "signal",
        "drive periods",
        "time of the last event before each point of the run",
        lambda fmu: fmu.record["last_event_time"] / fmu.drive_period,
        {
            "located_events": lambda reference: reference.event_times("located_events"),
            "taylor": lambda reference: reference.event_times("taylor"),
        },
        needs_run=True,
        in_periods=True,
    ),
    "last_event_time": Quantity(
        "number",
        "s",
        "time of the last event of the run",
        lambda fmu: fmu.record.final("last_event_time"),
        {"located_events": lambda reference: reference.last_event_time},
        needs_run=True,
    ),
    "ripple_amplitude": Quantity(
        "number",
        "m",
        "amplitude of the fast oscillation of the position",
        lambda fmu: ripple_amplitude(fmu.record.times, fmu.record["position"], fmu.drive_period),
        {"closed_form": lambda reference: reference.ripple_amplitude},
        needs_run=True,
    ),
    "ripple_frequency": Quantity(
        "number",
        "Hz",
        "dominant frequency of the velocity",
        lambda fmu: dominant_frequency(*_later_half(fmu.record.times, fmu.record["velocity"])),
        {"closed_form": lambda reference: 1.0 / reference.drive_period},
        needs_run=True,
    ),
    "beat_frequency": Quantity(
        "number",
        "Hz",
        "dominant frequency of the mean velocity in the later half of the run",
        lambda fmu: dominant_frequency(*_later_half(fmu.record.times, fmu.record["mean_velocity"])),
        {"closed_form": lambda reference: reference.difference_frequency},
        needs_run=True,
    ),
}
"""Every quantity by the name that scene files use."""
