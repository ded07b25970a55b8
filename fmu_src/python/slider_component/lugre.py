"""The event loop of LuGre friction (eq. 8): from one reversal to the next along the bristle's path.

Soon after a reversal the bristle is fully bent and friction is Coulomb's: closed forms take over.
Until then Taylor series follow the path, whose length shrinks with the bristle stiffness, so the
cost does not grow with it. There is no sticking; presliding is resolved as what it is, an
oscillation on the bristles.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf, tau

from .bristle import Bristle
from .clock import Clock
from .contact import is_lifted, time_to_switch
from .coulomb import (
    BACKWARD,
    FORWARD,
    LIFTED,
    LONGEST_ARC,
    MOST_STALLED,
    STICK,
    Counts,
    Held,
    Moment,
    friction_limit,
    slide,
    stalling,
)
from .first_zero import Watch, first_zero
from .motion import State
from .period import PeriodMeans
from .plant import Plant
from .refusal import too_much_work
from .regular_slide import RegularSlide
from .split_slide import SplitSlide
from .taylor_slide import TaylorSlide

SHARE = 0.01
"""Part of the tolerance that one series may use up, and that the bend of the bristle may still be
away from full when closed forms take over."""

MOST_LEGS = 20_000
"""Series and closed forms, for each turn of the fastest oscillation, up to which work is accepted:
several times what presliding on the hardest bristles takes."""


def velocity_scale(plant: Plant, state: State) -> float:
    """Velocity [m/s] that tolerances refer to: of drive, friction over a turn, and motion."""
    w = plant.drive_frequency
    forces = plant.friction_preload + plant.friction_amplitude + abs(plant.load)
    swing = plant.mass_fraction * hypot(state.rate, plant.stick.frequency * state.displacement)
    return abs(plant.drive) / w + forces / (plant.total_mass * w) + abs(state.velocity) + swing


def start(held: Held, bristle: Bristle, state: State, position: float, deflection: float) -> Moment:
    """The first moment, with the bristle deflected by `deflection` [m]."""
    mode = mode_of(held, state, 0.0)
    sliding = mode if mode in (FORWARD, BACKWARD) else 0
    bent = bristle.stiffness * deflection
    return Moment(state, position, 0.0, 0.0, mode, Counts(sliding), inf, PeriodMeans(), bent)


def mode_of(held: Held, state: State, psi: float) -> int:
    """Contact mode: lifted, or the direction of sliding; 0 only at rest."""
    if is_lifted(held.window, psi + held.plant.phase, held.plant.normal_frequency):
        return LIFTED
    if state.velocity == 0.0:
        return STICK
    return FORWARD if state.velocity > 0.0 else BACKWARD


def friction_force(held: Held, bristle: Bristle, moment: Moment, mode: int) -> float:
    """Friction force [N] on the slider in contact mode `mode` (eq. 8), positive against +X."""
    if mode == LIFTED:
        return 0.0
    velocity, bent = moment.state.velocity, moment.bristle
    drag = velocity - abs(velocity) * bent / bristle.coefficient
    share = (bent + bristle.damping * drag) / bristle.coefficient
    return friction_limit(held.plant, moment.psi) * share


def advance(
    held: Held, bristle: Bristle, tolerance: float, moment: Moment, duration: float
) -> Moment:
    """The moment `duration` > 0 [s] later, inputs held, to relative `tolerance`."""
    plant, window = held.plant, held.window
    w, q = plant.drive_frequency, plant.normal_frequency
    state, position, means, bent = moment.state, moment.position, moment.means, moment.bristle
    theta, psi, counts, age = moment.theta, moment.psi, moment.counts, moment.event_age
    lifted = is_lifted(window, psi + plant.phase, q)
    if lifted != (moment.mode == LIFTED):
        age = 0.0
    clock = Clock(duration)
    remaining = duration
    stalled = legs = 0
    turn = tau / LONGEST_ARC * held.arc
    while remaining > 0.0:
        legs += 1
        if legs > MOST_LEGS * (1.0 + clock.elapsed / turn):
            what = "series in a turn of the fastest oscillation"
            raise too_much_work(duration, clock.elapsed, MOST_LEGS, what)
        chi = psi + plant.phase
        leg = _leg(held, bristle, lifted, state, bent, theta, chi, tolerance)
        switch = time_to_switch(window, chi, q, lifted)
        t = min(remaining, switch, leg.reach)
        zero = first_zero(leg.watch(t), t)
        if zero is not None:
            t = zero
        travelled = leg.motion.travel(t)
        means, theta = means.advanced(t, theta, w, False, leg.motion.travel, travelled)
        position += travelled
        psi = (psi + q * t) % tau
        state = leg.motion.state(t)
        bent = bristle.after(bent, travelled)
        if travelled != 0.0 and counts.sliding != leg.direction:
            counts, age = counts.slid(leg.direction), 0.0
        age += t
        if zero is not None:
            state = State(0.0, state.displacement, state.rate)
        elif t == switch:
            lifted, age = not lifted, 0.0
        stalled = stalled + 1 if 1e12 * t < held.arc else 0
        if stalled > MOST_STALLED:
            raise stalling(duration, clock.elapsed)
        remaining = clock.advance(t) if t != remaining else 0.0
    mode = mode_of(held, state, psi) if not lifted else LIFTED
    return Moment(state, position, theta, psi, mode, counts, age, means, bent)


@dataclass(frozen=True, slots=True)
class _Leg:
    """A motion in one direction, how far it may be followed [s], and the velocity to watch."""

    motion: SplitSlide | RegularSlide | TaylorSlide
    direction: int
    reach: float

    @property
    def departs(self) -> bool:
        """Whether a slider at rest begins to move in this direction, or not at all."""
        if isinstance(self.motion, TaylorSlide):
            return self.motion.departs()
        (watch,) = self.motion.watches()
        return watch.signal(0.0)[1] >= 0.0

    def watch(self, horizon: float) -> Watch:
        """The velocity in this direction, up to `horizon` [s]."""
        if isinstance(self.motion, TaylorSlide):
            return self.motion.watch(horizon)
        (watch,) = self.motion.watches()
        return watch


def _leg(
    held: Held,
    bristle: Bristle,
    lifted: bool,
    state: State,
    bent: float,
    theta: float,
    chi: float,
    tolerance: float,
) -> _Leg:
    """The motion in the direction that the slider has, or at rest takes."""
    if state.velocity == 0.0:
        forward = _leg_in(FORWARD, held, bristle, lifted, state, bent, theta, chi, tolerance)
        if forward.departs:
            return forward
    direction = FORWARD if state.velocity > 0.0 else BACKWARD
    return _leg_in(direction, held, bristle, lifted, state, bent, theta, chi, tolerance)


def _leg_in(
    direction: int,
    held: Held,
    bristle: Bristle,
    lifted: bool,
    state: State,
    bent: float,
    theta: float,
    chi: float,
    tolerance: float,
) -> _Leg:
    unbent = bristle.coefficient - direction * bent
    if lifted or abs(unbent) <= SHARE * tolerance * bristle.coefficient:
        sign = 0 if lifted else direction
        return _Leg(slide(held, sign, state, theta, chi, direction), direction, held.arc)
    allowed = SHARE * tolerance * velocity_scale(held.plant, state)
    series = TaylorSlide(held.plant, bristle, direction, state, bent, theta, chi, allowed)
    return _Leg(series, direction, min(series.reach, held.arc))
