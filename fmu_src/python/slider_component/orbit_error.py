"""The error of slow motion along held orbits, carried on from step to step.

Under held inputs V errs by its acceleration times a time that grows by what orbits have gained (see
`orbit_shifts`). That depends on the first and the last velocity alone, so it is measured late:
where the estimate is read, or where inputs change. What a jump of inputs leaves as it is is the
error of W, which `ahead` keeps.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, hypot, inf, sqrt, tau

from .device import Device
from .fast_vibration import FastVibration
from .held_orbit import NoOrbitError, held_orbit_at, held_orbit_linearised
from .moment import Moment
from .orbit_drift import held_orbit_moment
from .orbit_panel import place_between
from .orbit_point import OrbitPoint
from .orbit_ride import OrbitRide
from .orbit_state import OpenError, OpenKind, OrbitState
from .resolved_start import (
    swing_by_inertia,
    velocity_by_friction,
    velocity_of_free_swing,
    velocity_of_swing,
)
from .shift_tables import gain_between, shifts_at
from .slow_motion_error import (
    decay_in_turn,
    drift_error,
    first_order_error,
    friction_share,
    resolution_error,
    second_order_error,
)

SETTLED = 1e-8
"""Acceleration, over that by all friction, below which the motion has settled."""

NEGLIGIBLE_ERROR = 1e-3
"""Error, over that of resolution, whose decay is not looked at once the motion has settled."""

SLOPE_STEP = 1e-6
"""Difference of velocities, over the fast one, for the slope of the acceleration."""

SEEN = 1.0
"""Decay of the resonator's swing in a turn that is seen in mean velocities of a turn."""

NEXT_TO_GRAZING = 0.05
"""Chi at which friction next to grazing is looked up."""

ROOT_SUM = 0.1
"""Error of a sum over periods of the root of what velocity lacks there, in the root of that of one:
0.21 at the worst phase, 0.07 at most of them."""


def is_without_error(orbit: OrbitState) -> bool:
    """Whether no orbit has been followed since resolved motion ended, so that it just goes on."""
    return orbit.open.kind == OpenKind.TAKEN_OVER and orbit.open.elapsed == 0.0


def jumped(device: Device, fast: FastVibration, orbit: OrbitState) -> OrbitState:
    """The state after a jump to another orbit, on which the resonator swings.

    Friction that this changes is not followed.
    """
    size = hypot(orbit.swing.displacement, orbit.swing.rate / device.drive_frequency)
    doubt = orbit.doubt + velocity_by_friction(device, fast, size)
    return orbit._replace(doubt=min(doubt, fast.velocity))


def left_orbits(device: Device, fast: FastVibration, orbit: OrbitState) -> OrbitState:
    """The state where resolved motion begins.

    With the error of the tables, and without the lag of the resonator.
    """
    swing = swing_by_inertia(device) * (1.0 + 1.0 / decay_in_turn(device))
    unrest = orbit.unrest + velocity_of_swing(device, swing * abs(orbit.acceleration))
    doubt = max(orbit.doubt, resolution_error(device, fast))
    return orbit._replace(doubt=min(doubt, fast.velocity), unrest=min(unrest, fast.velocity))


def calmed(device: Device, angle: float, orbit: OrbitState) -> OrbitState:
    """The state when the resonator's swing has decayed for a drive angle [rad]."""
    return orbit._replace(unrest=orbit.unrest * _calmed(device, angle))


def _calmed(device: Device, angle: float) -> float:
    return exp(-min(decay_in_turn(device), SEEN) * angle / tau)


@dataclass(frozen=True, slots=True)
class ErrorPlace:
    """What counts at one moment of a ride.

    Slow velocity [m/s] and acceleration [m/s^2]; the time [s] by which mean velocity is ahead of
    that of the motion with the same W, that by which single turns differ, and that which is
    unsure; the added mass, over the mass, that the table leaves out; and how far the resonator
    lags, over the acceleration [s^2]. `measured` is false where there are no shifts, `beyond` true
    where the slider never turns back.
    """

    velocity: float
    acceleration: float = 0.0
    lag: float = 0.0
    of_turn: float = 0.0
    unsure: float = 0.0
    left_out: float = 0.0
    swing: float = 0.0
    measured: bool = False
    beyond: bool = False


@dataclass(frozen=True, slots=True)
class ErrorRide:
    """A ride of a device whose vibration without friction is `fast`."""

    ride: OrbitRide
    device: Device
    fast: FastVibration

    def begun(
        self, point: OrbitPoint, velocity: float, theta: float, now: Moment, orbit: OrbitState
    ) -> OrbitState:
        """The state with what resolved motion leaves at a moment.

        Its W belongs to a velocity [m/s] and the orbit `point`; its drive phase is `theta` [rad]
        over all turns of the orbit.
        """
        return orbit._replace(
            acceleration=self._acceleration_on(point),
            open=OpenError(
                OpenKind.TAKEN_OVER,
                0.0,
                velocity,
                theta,
                now.state.displacement,
                now.state.rate,
            ),
        )

    def opened(self, theta: float, orbit: OrbitState) -> OrbitState:
        """The state from which an orbit is followed, at a drive phase [rad] over all turns."""
        if orbit.open.kind != OpenKind.NOTHING_OPEN:
            return orbit
        return orbit._replace(open=OpenError(OpenKind.FOLLOWED, 0.0, orbit.velocity, theta))

    def followed(
        self, point: OrbitPoint, theta: float, duration: float, orbit: OrbitState
    ) -> OrbitState:
        """The state when orbits have been followed for `duration` [s] to the orbit `point`.

        `orbit` has its `velocity` [m/s].
        """
        motion = orbit.open
        orbit = orbit._replace(open=motion._replace(elapsed=motion.elapsed + duration))
        return orbit if self._has_shifts else self._settled_on(point, theta, orbit)

    def settled(self, theta: float, orbit: OrbitState) -> OrbitState:
        """The state with all that is open, at a drive phase [rad] over all turns."""
        if orbit.open.kind == OpenKind.NOTHING_OPEN:
            return orbit
        return self._settled_on(self.ride.point(0.0, orbit.velocity), theta, orbit)

    def error(self, theta: float, orbit: OrbitState) -> float:
        """The estimate [m/s] for the mean velocity of the period that ends there."""
        orbit = self.settled(theta, orbit)
        place = self._place(orbit.velocity, theta)
        if not place.measured:
            point = self.ride.point(0.0, place.velocity)
            return max(orbit.doubt, self._unmeasured(point, self.ride.load))
        a = place.acceleration
        jump = abs(a - orbit.acceleration)
        jumped = velocity_of_swing(self.device, place.swing * jump)
        shifted = abs(orbit.ahead + place.lag * a) + (place.of_turn + place.unsure) * abs(a)
        error = shifted + orbit.doubt + orbit.unrest + jumped
        error += resolution_error(self.device, self.fast)
        return min(error, self.fast.velocity)

    @property
    def _has_shifts(self) -> bool:
        return self.ride.table.curve is not None

    def _place(self, velocity: float, theta: float) -> ErrorPlace:
        """The place at a velocity [m/s] and drive phase [rad] over all turns of the orbit.

        Under the inputs with which the ride begins.
        """
        ride, curve = self.ride, self.ride.table.curve
        found = ride.table.friction(ride.lead, velocity) if curve is not None else None
        if curve is None or found is None:
            return ErrorPlace(velocity)
        friction, factor = found
        beyond = place_between(curve.middle, curve.reach, velocity) < 0.0
        acceleration = -factor * (friction + ride.load) / ride.map.held.plant.total_mass
        shifts = shifts_at(curve, velocity, theta / (tau * ride.turns) % 1.0)
        if shifts is None:
            return ErrorPlace(velocity, acceleration, beyond=beyond)
        return ErrorPlace(
            velocity,
            acceleration,
            lag=shifts.lag,
            of_turn=shifts.of_turn,
            unsure=shifts.unsure,
            left_out=shifts.added_mass if factor == 1.0 else 0.0,
            swing=max(shifts.swing, swing_by_inertia(self.device)),
            measured=True,
            beyond=beyond,
        )

    def _settled_on(self, point: OrbitPoint, theta: float, orbit: OrbitState) -> OrbitState:
        """The state with what is open, up to the orbit `point`."""
        motion = orbit.open
        orbit = orbit._replace(open=OpenError())
        start = self._place(motion.velocity, motion.angle)
        if motion.kind == OpenKind.TAKEN_OVER:
            orbit = self._begun_at(start, motion, orbit)
        if motion.elapsed > 0.0:
            end = self._place(orbit.velocity, theta)
            orbit = self._carried(start, end, point, motion.elapsed, orbit)
        return orbit

    def _begun_at(self, place: ErrorPlace, motion: OpenError, orbit: OrbitState) -> OrbitState:
        """The state with the end of resolved motion."""
        unrest = self._error_of_swing(motion)
        doubt = orbit.doubt + place.unsure * abs(place.acceleration)
        if not place.measured:
            # An orbit that cannot be probed may differ by all that friction does.
            load = inf if self._has_shifts else self.ride.load
            doubt = max(doubt, self._unmeasured(self.ride.point(0.0, place.velocity), load))
        return self._bounded(orbit, orbit.ahead, doubt, unrest, orbit.acceleration)

    def _carried(
        self,
        start: ErrorPlace,
        end: ErrorPlace,
        point: OrbitPoint,
        duration: float,
        orbit: OrbitState,
    ) -> OrbitState:
        """The state with the error carried on over `duration` [s], to the orbit `point`."""
        curve = self.ride.table.curve
        calm = _calmed(self.device, duration * self.device.drive_frequency)
        gain = None
        if curve is not None and start.measured and end.measured:
            gain = gain_between(curve, start.velocity, end.velocity)
        if gain is None:
            return self._unmeasured_after(start, end, point, duration, orbit, orbit.unrest * calm)
        a = end.acceleration
        jump = abs(start.acceleration - orbit.acceleration)
        unrest = (orbit.unrest + velocity_of_swing(self.device, start.swing * jump)) * calm
        left = self._left_by_excess(start, end, duration, orbit)
        gained = gain.gained - 0.5 * (start.left_out + end.left_out) * duration
        error = left * (orbit.ahead + start.lag * start.acceleration) + gained * a
        doubt = left * (orbit.doubt + start.unsure * jump) + gain.unsure * abs(a)
        if start.beyond != end.beyond:
            there = start if start.beyond else end
            slower = abs(a) < abs(there.acceleration)
            share = abs(a / there.acceleration) if slower else 1.0
            doubt += self._grazing_error(there) * share
        return self._bounded(orbit, error - end.lag * a, doubt, unrest, a)

    def _bounded(
        self, orbit: OrbitState, ahead: float, doubt: float, unrest: float, acceleration: float
    ) -> OrbitState:
        """The state with these: no velocity errs by more than the vibration."""
        fast = self.fast.velocity
        return orbit._replace(
            ahead=max(min(ahead, fast), -fast),
            doubt=min(doubt, fast),
            unrest=min(unrest, fast),
            acceleration=acceleration,
        )

    def _error_of_swing(self, motion: OpenError) -> float:
        """What the swing that resolved motion leaves adds to mean velocity [m/s]."""
        scales, lead = self.ride.map, self.ride.lead
        try:
            orbit = held_orbit_linearised(scales, held_orbit_at(scales, lead, motion.velocity))
            there = held_orbit_moment(scales, orbit, self.ride.load, motion.angle)
        except NoOrbitError:
            return 0.0
        displacement = motion.displacement - there.state.displacement
        rate = (motion.rate - there.state.rate) / self.device.drive_frequency
        return velocity_of_free_swing(self.device, self.fast, hypot(displacement, rate))

    def _unmeasured_after(
        self,
        start: ErrorPlace,
        end: ErrorPlace,
        point: OrbitPoint,
        duration: float,
        orbit: OrbitState,
        unrest: float,
    ) -> OrbitState:
        """The state after `duration` [s] in which nothing is measured."""
        a = self._acceleration_on(point)
        if self._has_shifts:
            left = self._left_by_excess(start, end, duration, orbit)
        elif self.ride.searches:
            left = abs(a / orbit.acceleration) if abs(a) < abs(orbit.acceleration) else 1.0
        else:
            left = self._left_by_slope(end.velocity, duration)
        doubt = max(
            left * (orbit.doubt + abs(orbit.ahead)), self._unmeasured(point, self.ride.load)
        )
        return self._bounded(orbit, 0.0, doubt, unrest, a)

    def _left_by_slope(self, velocity: float, duration: float) -> float:
        """The share of an error of V that is left after `duration` [s].

        By the slope of the acceleration at the end.
        """
        step = SLOPE_STEP * self.fast.velocity
        more = self.ride.acceleration(duration, velocity + step)
        slope = more - self.ride.acceleration(duration, velocity - step)
        return exp(min(0.0, 0.5 * slope / step) * duration)

    def _left_by_excess(
        self, start: ErrorPlace, end: ErrorPlace, duration: float, orbit: OrbitState
    ) -> float:
        """The same where inputs are held: that of the acceleration."""
        share, fast = friction_share(self.device, self.fast), self.fast.velocity
        if abs(start.acceleration) > SETTLED * share * self.device.drive_frequency * fast:
            return abs(end.acceleration / start.acceleration)
        if abs(orbit.ahead) + orbit.doubt < NEGLIGIBLE_ERROR * resolution_error(
            self.device, self.fast
        ):
            return 1.0
        return self._left_by_slope(end.velocity, duration)

    def _grazing_error(self, beyond: ErrorPlace) -> float:
        """Error [m/s] of passing grazing, beyond which the orbit is `beyond`.

        Next to it friction grows by the root of the distance, within a period.
        """
        ride, curve = self.ride, self.ride.table.curve
        assert curve is not None
        sign = 1.0 if beyond.velocity > curve.middle else -1.0
        reach = curve.reach * (1.0 - 0.5 * NEXT_TO_GRAZING * NEXT_TO_GRAZING)
        inside = ride.table.friction(ride.lead, curve.middle + sign * reach)
        outside = ride.table.friction(ride.lead, beyond.velocity)
        if inside is None or outside is None:
            return 0.0
        period, mass = ride.map.period, ride.map.held.plant.total_mass
        chi = sqrt(2.0 * abs(beyond.acceleration) * period / curve.reach)
        return ROOT_SUM * period / mass * abs(outside[0] - inside[0]) / NEXT_TO_GRAZING * chi

    def _acceleration_on(self, point: OrbitPoint) -> float:
        """Slow acceleration [m/s^2] on an orbit."""
        force = point.of.friction + self.ride.load
        return -point.of.factor * force / self.ride.map.held.plant.total_mass

    def _unmeasured(self, point: OrbitPoint, load: float) -> float:
        """The error [m/s] under a load [N] where nothing is measured."""
        if not point.found:
            return first_order_error(self.device, self.fast)
        return self._by_rule(point.of.factor - 1.0, point.of.friction + load)

    def _by_rule(self, added_mass: float, force: float) -> float:
        """The same where friction adds a mass, and friction and load leave a force [N]."""
        squares = second_order_error(self.device, self.fast, added_mass, force)
        drift = self.ride.turns * abs(self.ride.slow.drift)
        return squares + drift_error(self.device, self.fast, drift)
