"""Averaged motion of second order, fidelity 0: the slow motion along held orbits.

With W = X' + r Y' + D cos(theta) / (w Mt), exactly Mt W' = -friction - load. On a held orbit
W = V + w1, and the slow velocity V obeys

    Mt V' = -(1 + kappa_m) (F2(V, lead) + load)

with the mean friction F2 of the orbit and the added mass kappa_m of friction. The resonator's own
swing is no slow motion: after a start and where the drive is tuned the motion is resolved until it
has decayed. A load leaves V as it is; another phase, preload or amplitude leaves W.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, remainder, tau

from . import events
from .budget import Budget
from .device import Device, Inputs
from .fast_vibration import FastVibration
from .friction_law import FrictionLaw
from .held import Held
from .moment import Counts, Moment
from .motion import State
from .orbit_bend import orbit_bend_decay, velocity_of_bend
from .orbit_changes import noted, orbit_values
from .orbit_error import ErrorRide, calmed, is_without_error, jumped, left_orbits
from .orbit_follow import LostOrbitError, followed
from .orbit_price import is_due, orbit_price, with_paid
from .orbit_ride import OrbitRide, begin_ride, orbit_phase_of
from .orbit_state import OpenError, OpenKind, OrbitState, Stage, Swing
from .period import PeriodMeans
from .resolved_start import bend_angle, lag_angle, resolved_angle, resolved_is_bounded
from .slow_friction import SlowFriction, slow_friction
from .slow_motion_error import (
    decay_in_turn,
    first_order_error,
    resolved_error,
    slow_decay_in_turn,
)
from .slow_phase import rounded_lead

TAKEN = 1e-14
"""Change of the slow velocity at which it belongs to W, over the fast velocity."""

MAX_TAKING = 40
"""Iterations to there."""

NOTHING = 1e-9
"""Drive angle [rad] that is not worth a step of its own."""

SEPARATION = 1.0
"""Largest decay of the slow motion in a turn over that of the resonator."""


def has_slow_motion(device: Device, inputs: Inputs, fast: FastVibration) -> bool:
    """Whether the motion becomes slow.

    The vibration decays to one that breaks the contact loose, faster than the slow motion, and the
    phase of the normal load is slow.
    """
    if not fast.velocity > 0.0 or not orbit_phase_of(device, inputs.frequency_ratio).turns:
        return False
    slow = slow_decay_in_turn(device, fast)
    separate = 0.0 < slow < SEPARATION * decay_in_turn(device) and slow < 1.0
    return separate and resolved_is_bounded(device, fast)


@dataclass(frozen=True, slots=True)
class OrbitLaw:
    """The device along orbits under held inputs (see `law.Law`).

    `held` is that of averaged motion, `full` that of the full device, `resolved` the same at the
    tolerance of resolved motion.
    """

    held: Held
    full: Held
    resolved: Held
    friction: FrictionLaw
    fast: FastVibration

    def start(self, state: State, position: float) -> Moment:
        """See Law."""
        bristle = self.friction.first_bristle(self.full)
        moment = Moment(state, position, 0.0, 0.0, 0, Counts(), inf, PeriodMeans(), bristle)
        moment.mode = self.mode(moment)
        to_go = resolved_angle(self.full.device, self.fast, state, 0.0)
        moment.orbit = OrbitState(
            Stage.RESOLVED, to_go, under=orbit_values(self.full.device, self.full.inputs)
        )
        return moment

    def advance(self, moment: Moment, duration: float) -> Moment:
        """See Law."""
        now = self._adapted(moment.copied())
        budget, left = Budget(duration), duration
        if now.orbit.stage == Stage.RESOLVED:
            now, time = self._resolved(now, duration, budget)
            left = duration - time if time < duration else 0.0
        if not left * self.full.plant.drive_frequency > 0.0:
            return now
        if now.orbit.stage != Stage.RESOLVED:
            ride = self._ride(now, now.orbit.lead).within(left)
            after = followed(self.full, self.fast, ride, now, left, budget)
            if after is not None:
                return after
            now.orbit = self._resolved_for(now, now.orbit, ride.unknown.angle)
        return self._advanced(now, left, budget)

    def mode(self, moment: Moment) -> int:
        """See Law."""
        return self.friction.mode(self.full, moment)

    def friction_force(self, moment: Moment, mode: int) -> float:
        """See Law."""
        return self.friction.force(self.full, moment, mode)

    def swing(self, moment: Moment) -> tuple[float, float]:
        """See Law."""
        return moment.state.displacement, moment.state.rate

    def settled(self, moment: Moment) -> Moment:
        """See Law."""
        return replace(moment, orbit=self._settled(moment, moment.orbit))

    def _settled(self, now: Moment, orbit: OrbitState) -> OrbitState:
        """The state of a moment when the estimate of the error has taken in all that is open."""
        if orbit.open.kind == OpenKind.NOTHING_OPEN:
            return orbit
        ride = self._ride(now, orbit.lead)
        theta = ride.theta(0.0, now.theta, self.full.inputs.phase + now.psi)
        return self._errors(ride).settled(theta, orbit)

    def slow_motion_error(self, moment: Moment) -> float:
        """See Law."""
        device, orbit = self.full.device, moment.orbit
        if orbit.stage == Stage.AVERAGED:
            return first_order_error(device, self.fast)
        if orbit.stage != Stage.ON_ORBIT:
            error = abs(orbit.ahead) + orbit.doubt + orbit.unrest
            resolved = self.resolved
            error += resolved_error(resolved.device, resolved.plant, self.fast, orbit.waited)
            return min(error, self.fast.velocity)
        ride = self._ride(moment, orbit.lead)
        theta = ride.theta(0.0, moment.theta, self.full.inputs.phase + moment.psi)
        return self._errors(ride).error(theta, orbit)

    def _errors(self, ride: OrbitRide) -> ErrorRide:
        return ErrorRide(ride, self.full.device, self.fast)

    def _lead(self, moment: Moment) -> float:
        """The lead [rad] at drive phase 0 of the turn in which it is least, rounded."""
        device, inputs = self.full.device, self.full.inputs
        turns, waves, _ = orbit_phase_of(device, inputs.frequency_ratio)
        if device.normal_amplitude == 0.0:
            return 0.0
        chi, least = inputs.phase + moment.psi, inf
        for turn in range(turns or 1):
            lead = rounded_lead(remainder(chi - waves * (moment.theta + tau * turn), tau))
            least = min(least, lead + tau if lead < 0.0 else lead)
        return least

    def _ride(self, moment: Moment, lead: float) -> OrbitRide:
        inputs = self.full.inputs
        first = self._first_order(moment)
        return begin_ride(
            self.full.device, inputs.frequency_ratio, moment.orbit, lead, first, inputs.load
        )

    def _first_order(self, moment: Moment) -> SlowFriction:
        averaged = self.friction.averaged
        return slow_friction(self.held, averaged, self.fast, moment.theta, moment.psi)

    def _adapted(self, now: Moment) -> Moment:
        """Follow changes since the last step: to other orbits, or by resolved motion."""
        device = self.full.device
        orbit, changes = noted(device, self.full.inputs, self.fast, now.orbit)
        anew = changes.tuned or changes.led
        changed = changes.shaken or anew or changes.turned
        starts = orbit.stage == Stage.RESOLVED and orbit.waited == 0.0
        if changes.shaken:
            angle = resolved_angle(device, self.fast, now.state, now.theta)
            orbit = self._resolved_for(now, orbit, angle)
        now.orbit = orbit
        ratio = self.full.inputs.frequency_ratio
        resolved = orbit.stage == Stage.RESOLVED
        if (starts or not changed) if resolved else not (changed or changes.loaded):
            return now
        lead = self._lead(now) if anew or resolved else orbit.lead
        price = orbit_price(device, ratio, orbit, lead, changed=changed)
        if resolved:
            now.orbit = self._resolved_for(now, orbit, price - orbit.waited)
            return now
        if price > 0.0:
            now.orbit = with_paid(device, ratio, self._resolved_for(now, orbit, price), lead)
            return now
        if anew:
            now, factor = self._taken_over(now)
        elif changes.loaded and device.friction_law != 0:
            factor = self._ride(now, orbit.lead).point(0.0, orbit.velocity).of.factor
        else:
            return now
        lag = lag_angle(device, self.fast, factor - 1.0)
        if lag > 0.0:
            now.orbit = self._resolved_for(now, now.orbit, lag)
        return now

    def _resolved_for(self, now: Moment, orbit: OrbitState, angle: float) -> OrbitState:
        """The state when motion is to be resolved from a moment on for a drive angle [rad]."""
        if orbit.stage != Stage.RESOLVED and is_without_error(orbit):
            orbit = orbit._replace(open=OpenError())
        elif orbit.stage != Stage.RESOLVED:
            orbit = left_orbits(self.full.device, self.fast, self._settled(now, orbit))
        return orbit.resolved_for(angle)

    def _taken_over(self, now: Moment) -> tuple[Moment, float]:
        """Go over to the orbit whose W and centre are those of a moment; gives 1 + kappa_m.

        Where there is no orbit, motion is resolved on.
        """
        orbit, lead = now.orbit, self._lead(now)
        ratio = self.full.inputs.frequency_ratio
        if is_due(self.full.device, ratio, orbit):
            orbit = with_paid(self.full.device, ratio, orbit, lead)
        now.orbit = orbit = orbit._replace(lead=lead, leads=orbit.leads.visited(lead))
        ride = self._ride(now, lead)
        share = ride.map.held.plant.mass_fraction
        theta = ride.theta(0.0, now.theta, self.full.inputs.phase + now.psi)
        momentum = ride.map.momentum_velocity(now.state, now.theta)
        velocity, settled = momentum, False
        for _ in range(MAX_TAKING):
            found = ride.moment(0.0, theta, velocity, 0.0)
            if found is None:
                raise LostOrbitError
            there, point = found
            if ride.unknown.angle > 0.0:
                now.orbit = self._resolved_for(now, orbit, ride.unknown.angle)
                return now, 1.0
            following = velocity + momentum - ride.map.momentum_velocity(there.state, theta)
            settled = abs(following - velocity) <= TAKEN * ride.map.speed
            velocity = following
            if settled:
                break
        apart = now.state.displacement - there.state.displacement
        centre = now.position + share * apart
        if orbit.stage == Stage.ON_ORBIT:
            swing = Swing(apart, now.state.rate - there.state.rate)
            orbit = jumped(self.full.device, self.fast, orbit._replace(swing=swing))
        else:
            # What is apart after resolved motion is how far it lags behind the orbit: it stays.
            orbit = self._errors(ride).begun(point, velocity, theta, now, orbit)
            orbit = orbit._replace(swing=Swing())
            now.position = centre
        now.orbit = orbit._replace(
            stage=Stage.ON_ORBIT,
            to_go=0.0,
            waited=0.0,
            velocity=velocity,
            centre=centre - there.position,
        )
        return now, point.of.factor

    def _resolved(self, now: Moment, duration: float, budget: Budget) -> tuple[Moment, float]:
        """Resolve the motion for as long as it has to be; gives the time [s] that took."""
        w = self.full.plant.drive_frequency
        to_go = now.orbit.to_go
        ends = to_go <= w * duration + NOTHING
        time = min(to_go / w, duration) if ends else duration
        if time * w > NOTHING or not ends:
            now = self._advanced(now, time, budget)
        else:
            time = 0.0
        return self._end_resolved(now, time, duration, budget) if ends else (now, time)

    def _end_resolved(
        self, now: Moment, time: float, duration: float, budget: Budget
    ) -> tuple[Moment, float]:
        """Go over to orbits, as soon as the bend of the bristle has decayed.

        Until then motion is resolved on, `time` [s] after the beginning of a step of `duration`
        [s] and up to its end. Gives the time that took in all.
        """
        w, period_map = self.full.plant.drive_frequency, self._ride(now, now.orbit.lead).map
        while True:
            orbit, decay = now.orbit, orbit_bend_decay(period_map, self.fast, self._lead(now), now)
            to_go = bend_angle(decay) - orbit.waited
            if not to_go > NOTHING:
                bend = velocity_of_bend(self.full.device, self.fast, decay, orbit.waited)
                now, _ = self._taken_over(now)
                if now.orbit.stage == Stage.ON_ORBIT:
                    now.orbit = now.orbit._replace(doubt=now.orbit.doubt + bend)
                return now, time
            left = min(to_go / w, duration - time)
            now.orbit = orbit._replace(to_go=to_go)
            if not left * w > NOTHING:
                return now, time
            now = self._advanced(now, left, budget)
            time += left

    def _advanced(self, now: Moment, time: float, budget: Budget) -> Moment:
        """The moment after a time [s] of resolved motion."""
        turned = self.full.plant.drive_frequency * time
        now = events.advance(self.friction, self.resolved, now, time, budget)
        to_go, waited = max(0.0, now.orbit.to_go - turned), now.orbit.waited + turned
        orbit = now.orbit._replace(to_go=to_go, waited=waited)
        now.orbit = calmed(self.full.device, turned, orbit)
        return now
