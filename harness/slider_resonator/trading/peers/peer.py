"""A peer: another method on the same equations, by the setting that its error depends on."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.steady.reference_steady import Simulate
from slider_resonator.trading.solution import Solution, last_events

Follow = Callable[[Device, Sequence[HeldInputs], Array], Solution]

NO_EVENTS = {"event_times": "no event is located"}
NOT_SHOT = dict.fromkeys(
    ("steady_velocity", "blocking_force"), "shooting needs a start in any state of the full device"
)


@dataclass(frozen=True)
class Peer:
    """A method by the setting that its error depends on.

    `simulate`, where there is one, can start in any state, as shooting requires; `shooting` is the
    accuracy in units of the state.
    """

    family: str
    setting: str
    tolerance: float | None
    follow: Follow
    simulate: Simulate | None = None
    shooting: float = 1e-9
    cannot_stick: bool = False
    missing: Mapping[str, str] = field(default_factory=dict)


def solution_of(run: Trajectory, *, located: bool) -> Solution:
    """Return a trajectory as a solution; reversals stand for events that are not located."""
    return Solution(
        times=run.time,
        position=run.position,
        velocity=run.velocity,
        last_event=last_events(run.event_times, run.time) if located else None,
        steps=run.steps or None,
        evaluations=run.evaluations,
        events=len(run.event_times) if located else run.reversals,
    )
