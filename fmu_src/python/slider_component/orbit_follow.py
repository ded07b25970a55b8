"""The slow motion along the orbits of a ride."""

from __future__ import annotations

from dataclasses import replace
from math import floor, inf, tau

from .budget import Budget
from .constants import MAX_SLOW_STEPS, PYTHON_SLOWDOWN
from .dormand_prince import Reached
from .fast_vibration import FastVibration
from .held import Held
from .moment import Moment
from .orbit_error import ErrorRide
from .orbit_point import OrbitPoint
from .orbit_price import is_due, with_paid
from .orbit_ride import OrbitRide
from .orbit_state import Swing
from .orbit_swing import swing_after, with_swing
from .period import MARK_TOLERANCE
from .slow_motion_error import friction_share
from .slow_pass import SlowPass, first_step

TOLERANCE = 3e-10
"""Error per step of the slow motion, relative to the fast velocity."""


class LostOrbitError(ArithmeticError):
    """The motion on an orbit left the range of floating point."""


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
    step = first_step(fast.velocity, plant.total_mass, sliding + abs(plant.load), duration)
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
    errors = ErrorRide(ride, full.device, fast)
    orbit = errors.opened(ride.theta(0.0, now.theta, chi), orbit)

    def moment_at(theta: float) -> tuple[Moment, Swing, OrbitPoint]:
        t = reached.t
        phase = ride.theta(t, theta, chi + q * t)
        found = ride.moment(t, phase, reached.velocity, orbit.centre + reached.moved)
        if found is None:
            raise LostOrbitError
        swing = swing_after(plant, orbit.swing, t)
        return with_swing(found[0], swing, plant.mass_fraction), swing, found[1]

    last = (tau * floor((now.theta + w * duration + MARK_TOLERANCE) / tau) - now.theta) / w
    marks: list[tuple[float, float]] = []
    for mark in (last - tau / w, last):
        if 0.0 < mark < duration:
            before = reached.step
            reached = slow_pass.reach(mark, reached, budget)
            if ride.unknown.angle > 0.0:
                return None
            reached = reached._replace(step=max(reached.step, before))
            marks.append((mark, moment_at(0.0)[0].position - start))
    reached = slow_pass.reach(duration, reached, budget)
    if ride.unknown.angle > 0.0:
        return None
    reached = reached._replace(t=duration)
    end = (now.theta + w * duration) % tau
    there, swing, point = moment_at(end)
    if ride.unknown.angle > 0.0:
        return None
    moved = orbit.centre + reached.moved
    orbit = orbit._replace(velocity=reached.velocity, centre=moved, swing=swing)
    phase = ride.theta(duration, end, chi + q * duration)
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
