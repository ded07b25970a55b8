"""The slow motion along the orbits of a ride."""

from __future__ import annotations

from dataclasses import replace
from math import floor, inf, tau
from typing import NamedTuple

from .budget import Budget
from .constants import MAX_SLOW_STEPS, PYTHON_SLOWDOWN
from .dormand_prince import Reached
from .fast_vibration import FastVibration
from .held import Held
from .moment import Moment
from .motion import EPSILON
from .orbit_error import ErrorRide
from .orbit_point import OrbitPoint
from .orbit_price import is_due, with_paid
from .orbit_ride import OrbitRide
from .orbit_swing import swing_after, with_swing
from .period import MARK_TOLERANCE
from .settling import is_settled
from .slow_motion_error import friction_share
from .slow_pass import SlowPass, first_step

TOLERANCE = 3e-10
"""Error per step of the slow motion, relative to the fast velocity."""

ROUNDING = 8.0
"""Rounding error of an acceleration, in units of the last place of that by friction and load."""


class LostOrbitError(ArithmeticError):
    """The motion on an orbit left the range of floating point."""


class RidePlace(NamedTuple):
    """How far `ahead` [m] of its slow centre the slider is.

    At a slow velocity [m/s] and a drive phase [rad] over all turns.
    """

    velocity: float
    theta: float
    ahead: float


def followed(
    full: Held, fast: FastVibration, ride: OrbitRide, now: Moment, duration: float, budget: Budget
) -> Moment | None:
    """Go along orbits for `duration` [s], the last part of a step.

    None where one on the way is unknown.
    """
    plant, orbit = full.plant, now.orbit
    w, q = plant.drive_frequency, plant.normal_frequency
    chi, start = full.inputs.phase + now.psi, now.position
    drift = ride.slow.drift
    sliding = friction_share(full.device, fast) * plant.total_mass * w * fast.velocity
    strongest = sliding + abs(plant.load)
    noise = ROUNDING * EPSILON * strongest / plant.total_mass
    step = first_step(fast.velocity, plant.total_mass, strongest, duration)
    slow_pass = SlowPass(
        ride.acceleration,
        fast.velocity,
        TOLERANCE * fast.velocity,
        step,
        may_settle=drift == 0.0 and not ride.searches,
        max_steps=MAX_SLOW_STEPS // PYTHON_SLOWDOWN,
        beat=ride.slow.beat,
        to_kink=ride.first.to_kink,
    )
    reached = Reached(0.0, orbit.velocity, 0.0, step)
    settled = slow_pass.may_settle and is_settled(ride.acceleration, fast.velocity, noise, reached)
    errors = ErrorRide(ride, full.device, fast)
    orbit = errors.opened(ride.theta(0.0, now.theta, chi), orbit)

    def reach(end: float) -> Reached:
        """Follow the slow motion up to time `end` [s]; where it is settled the velocity stays."""
        if not settled:
            return slow_pass.reach(end, reached, budget)
        moved = reached.moved + reached.velocity * (end - reached.t)
        return reached._replace(t=end, moved=moved)

    def moment_at(phase: float, centre: float) -> tuple[Moment, OrbitPoint]:
        found = ride.moment(reached.t, phase, reached.velocity, centre)
        if found is None:
            raise LostOrbitError
        return found

    last = (tau * floor((now.theta + w * duration + MARK_TOLERANCE) / tau) - now.theta) / w
    marks: list[tuple[float, float]] = []
    place: RidePlace | None = None
    for mark in (last - tau / w, last):
        if 0.0 < mark < duration:
            before = reached.step
            reached = reach(mark)
            if ride.unknown.angle > 0.0:
                return None
            reached = reached._replace(step=max(reached.step, before))
            phase = ride.theta(reached.t, 0.0, chi + q * reached.t)
            if not (settled and place is not None and place[:2] == (reached.velocity, phase)):
                ahead = moment_at(phase, 0.0)[0].position
                place = RidePlace(reached.velocity, phase, ahead)
            swing = swing_after(plant, orbit.swing, reached.t)
            ahead = place.ahead - plant.mass_fraction * swing.displacement
            marks.append((mark, orbit.centre + reached.moved + ahead - start))
    reached = reach(duration)
    if ride.unknown.angle > 0.0:
        return None
    reached = reached._replace(t=duration)
    end = (now.theta + w * duration) % tau
    moved = orbit.centre + reached.moved
    phase = ride.theta(duration, end, chi + q * duration)
    there, point = moment_at(phase, moved)
    if ride.unknown.angle > 0.0:
        return None
    swing = swing_after(plant, orbit.swing, duration)
    there = with_swing(there, swing, plant.mass_fraction)
    orbit = orbit._replace(velocity=reached.velocity, centre=moved, swing=swing)
    orbit = errors.followed(point, phase, duration, orbit)
    travelled = there.position - start

    def travel_at(t: float) -> float:
        rest = duration - t
        if abs(rest) * w <= MARK_TOLERANCE:
            return travelled - there.state.velocity * rest
        return min(marks, key=lambda mark: abs(mark[0] - t))[1]

    means, theta = now.means.advanced(duration, now.theta, w, False, travel_at, travelled)
    lead = ride.lead_at(duration)
    if drift != 0.0:
        orbit = orbit._replace(waited=orbit.waited + w * duration)
        ratio = full.inputs.frequency_ratio
        if is_due(full.device, ratio, orbit):
            orbit = with_paid(full.device, ratio, orbit, lead)
    return replace(
        now,
        state=there.state,
        position=there.position,
        theta=theta,
        psi=(now.psi + q * duration) % tau,
        mode=there.mode,
        event_age=inf,
        means=means,
        bristle=there.bristle,
        orbit=orbit._replace(lead=lead % tau if drift != 0.0 else lead),
    )
