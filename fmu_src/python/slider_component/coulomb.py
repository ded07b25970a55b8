"""The event loop of Coulomb friction: closed-form motion from one event to the next.

Events are a stop of the slider (then it sticks if friction can hold it, and reverses otherwise), a
release, and the lift-off and touchdown of the contact. There is no step size and no tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, inf, sin, tau
from typing import NamedTuple

from .clock import Clock
from .contact import flight_window, is_lifted, time_to_switch
from .departure import departure_time
from .device import Device, Inputs
from .first_zero import first_zero
from .motion import EPSILON, Motion, State
from .period import PeriodMeans
from .plant import Plant, plant
from .refusal import Refusal, too_much_work
from .regular_slide import RegularSlide
from .split_slide import Split, SplitSlide, split
from .stick import Stick

BACKWARD, STICK, FORWARD, LIFTED = -1, 0, 1, 2

LONGEST_ARC = 60.0
"""Angle [rad] of the fastest oscillation after which a motion is anchored anew: keeps the rounding
of large arguments of sine and cosine out."""

SAME = 1e-6
"""Share of the longest arc within which a release and a lift-off may be the same event."""

STALLED = 1e-6
"""Share of the longest arc below which a motion counts as no progress in time."""

MOST_STALLED = 1000
"""Events in a row without progress in time that are followed before a step is refused."""


@dataclass(frozen=True, slots=True)
class Held:
    """What stays the same while inputs and parameters do."""

    plant: Plant
    split: Split | None
    window: tuple[float, float] | None
    arc: float


class Counts(NamedTuple):
    """Direction of the last sliding (0 before any), reversals of it, and sticks begun."""

    sliding: int = 0
    reversals: int = 0
    sticks: int = 0

    def begun(self, mode: int) -> Counts:
        """The counts once contact mode `mode` has begun."""
        return self._replace(sticks=self.sticks + 1) if mode == STICK else self

    def slid(self, direction: int) -> Counts:
        """The counts once the slider has moved on in `direction`."""
        return Counts(direction, self.reversals + (self.sliding == -direction), self.sticks)


@dataclass(frozen=True, slots=True)
class Moment:
    """Everything that the motion carries on: position [m], phases [rad], contact mode.

    `event_age` is the time [s] since the last event, infinite before any; `bristle` is the friction
    sigma_0 z of the bristle per unit normal load, 0 with Coulomb friction.
    """

    state: State
    position: float
    theta: float
    psi: float
    mode: int
    counts: Counts
    event_age: float
    means: PeriodMeans
    bristle: float = 0.0


def hold(device: Device, inputs: Inputs) -> Held:
    """Prepare motion of `device` under `inputs`. Raises Refusal as `plant` does."""
    held = plant(device, inputs)
    fastest = max(held.drive_frequency, abs(held.normal_frequency))
    if held.resolves_resonator:
        fastest = max(
            [fastest] + [o.frequency for o in (held.slip, held.stick) if o.eigenvalue is not None]
        )
    return Held(held, split(held), flight_window(held), LONGEST_ARC / fastest)


def start(held: Held, state: State, position: float) -> Moment:
    """The first moment, at drive and normal phase 0."""
    mode = mode_of(held, state, 0.0, 0.0)
    sliding = mode if mode in (FORWARD, BACKWARD) else 0
    return Moment(state, position, 0.0, 0.0, mode, Counts(sliding), inf, PeriodMeans())


def needed_force(plant: Plant, state: State, theta: float) -> float:
    """Friction force [N] that holds a slider at rest."""
    resonator = plant.spring * state.displacement + plant.damper * state.rate
    direct = plant.holding_drive
    return resonator - plant.load + direct.real * sin(theta) + direct.imag * cos(theta)


def friction_limit(plant: Plant, psi: float) -> float:
    """Largest friction force [N] at normal phase `psi`, 0 in flight."""
    return max(0.0, plant.friction_preload + plant.friction_amplitude * sin(psi + plant.phase))


def mode_of(held: Held, state: State, theta: float, psi: float) -> int:
    """Contact mode of `state` under the held inputs."""
    if is_lifted(held.window, psi + held.plant.phase, held.plant.normal_frequency):
        return LIFTED
    return _mode_in_contact(held.plant, state, theta, psi)


def friction_force(held: Held, moment: Moment, mode: int) -> float:
    """Friction force [N] on the slider in contact mode `mode`, positive against +X."""
    if mode == LIFTED:
        return 0.0
    if mode == STICK:
        return needed_force(held.plant, moment.state, moment.theta)
    return mode * friction_limit(held.plant, moment.psi)


def advance(held: Held, moment: Moment, duration: float) -> Moment:
    """The moment `duration` > 0 [s] later, inputs held."""
    plant, window, arc = held.plant, held.window, held.arc
    w, q = plant.drive_frequency, plant.normal_frequency
    state, position, means = moment.state, moment.position, moment.means
    theta, psi, counts, age = moment.theta, moment.psi, moment.counts, moment.event_age
    mode = mode_of(held, state, theta, psi)
    if mode != moment.mode:
        counts, age = counts.begun(mode), 0.0
    leaving = state.velocity == 0.0
    clock = Clock(duration)
    remaining = duration
    stalled = 0
    while True:
        chi = psi + plant.phase
        motion = _motion(held, mode, state, theta, chi)
        switch = time_to_switch(window, chi, q, mode == LIFTED)
        t = until = min(remaining, switch, arc)
        ended_by, begin = -1, 0.0
        if leaving and mode in (FORWARD, BACKWARD):
            begin = departure_time(plant, mode, state, theta, chi)
        for index, watch in enumerate(motion.watches()):
            zero = first_zero(watch, t, begin)
            if zero is not None:
                t, ended_by = zero, index
        near_switch = switch == until and switch - t < SAME * arc
        if ended_by >= 0 and mode == STICK and near_switch and _lifts_first(plant, chi + q * t):
            t, ended_by = switch, -1
        travelled = motion.travel(t)
        means, theta = means.advanced(t, theta, w, mode == STICK, motion.travel, travelled)
        position += travelled
        psi = (psi + q * t) % tau
        state = motion.state(t)
        age += t
        if travelled * mode > 0.0 and mode != counts.sliding and mode != LIFTED:
            counts = counts.slid(mode)
        before, leaving = mode, False
        if ended_by >= 0 and mode == STICK:
            mode = (FORWARD, BACKWARD)[ended_by]
            leaving = True
        elif ended_by >= 0:
            state = State(0.0, state.displacement, state.rate)
            mode = _mode_in_contact(plant, state, theta, psi)
            leaving = mode == before
        elif t == switch:
            mode = _mode_in_contact(plant, state, theta, psi) if mode == LIFTED else LIFTED
        stalled = 0 if t > STALLED * arc else stalled + 1
        if stalled > MOST_STALLED:
            raise stalling(duration, clock.elapsed)
        if mode != before:
            counts, age = counts.begun(mode), 0.0
        if t == remaining:
            break
        remaining = clock.advance(t)
        if remaining <= 0.0:
            break
    return Moment(state, position, theta, psi, mode, counts, age, means, moment.bristle)


def stalling(duration: float, reached: float) -> Refusal:
    """The refusal of a step of `duration` [s] in which time does not get on after `reached` [s]."""
    return too_much_work(duration, reached, MOST_STALLED, "events at one instant")


def _lifts_first(plant: Plant, chi: float) -> bool:
    """Whether a stick ends only because the contact lifts: all friction is gone by then."""
    limit = plant.friction_preload + plant.friction_amplitude * sin(chi)
    return limit <= 16.0 * EPSILON * (plant.friction_preload + plant.friction_amplitude)


def _mode_in_contact(plant: Plant, state: State, theta: float, psi: float) -> int:
    if state.velocity != 0.0:
        return FORWARD if state.velocity > 0.0 else BACKWARD
    needed = needed_force(plant, state, theta)
    limit = friction_limit(plant, psi)
    if needed > limit:
        return FORWARD
    return BACKWARD if needed < -limit else STICK


def slide(
    held: Held, sign: int, state: State, theta: float, chi: float, direction: int
) -> SplitSlide | RegularSlide:
    """Sliding or flight in closed form, by the form that serves the device."""
    if held.split is not None:
        return SplitSlide(held.split, sign, state, theta, chi, direction)
    return RegularSlide(held.plant, sign, state, theta, chi, direction)


def _motion(held: Held, mode: int, state: State, theta: float, chi: float) -> Motion:
    if mode == STICK:
        return Stick(held.plant, state, theta, chi)
    sign = 0 if mode == LIFTED else mode
    return slide(held, sign, state, theta, chi, sign)
