"""The orbit on which slow motion rides: from tables, or found directly."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import Enum, auto
from math import cos, floor, inf, nan, remainder, sin, sqrt, tau

from .constants import MAP_WAVES, MAX_STEP_MAPS
from .contact import BACKWARD, FORWARD
from .device import Device
from .fast_vibration import steady_swing
from .moment import Moment
from .motion import State
from .orbit_point import OrbitPoint, Quantities
from .orbit_search import OrbitSearch
from .orbit_state import MAX_LEADS, MAX_TUNINGS, OrbitState
from .orbit_tables import OrbitTable, combined_table, curve_table, orbit_map, series_table
from .period_map import PeriodMap
from .slow_friction import SlowFriction
from .slow_phase import SlowPhase, slow_phase_of

MAX_RATE = 300.0
"""Rates of the motion over the drive frequency up to which a turn of the drive is resolved often
enough to find orbits."""

MAX_ORBIT_WAVES = 30.0
"""Waves of the normal load in a turn of the drive up to which orbits are found in some seconds."""


def orbit_phase_of(device: Device, ratio: float) -> SlowPhase:
    """The slow phase that counts for orbits: that of a load that does not vibrate stands still.

    `turns` is None, too, where a turn of the drive holds far faster motion.
    """
    slow = SlowPhase(1, 1.0, 0.0)
    if device.normal_amplitude > 0.0:
        slow = slow_phase_of(device, ratio)
    return slow if _is_affordable(device, slow.waves) else slow._replace(turns=None)


def _is_affordable(device: Device, waves: float) -> bool:
    limit, wn = MAX_RATE * device.drive_frequency, device.resonator_frequency
    free_share = device.slider_mass / device.total_mass
    damping = 2.0 * device.damping_ratio * wn / free_share
    resonator = wn <= limit * sqrt(free_share) and damping <= limit
    if device.friction_law == 0:
        return abs(waves) <= MAX_ORBIT_WAVES and resonator
    normal = device.normal_preload + device.normal_amplitude
    grip = device.friction_faces * normal / device.slider_mass
    bristle = grip * device.bristle_damping <= limit
    bristle = bristle and grip * device.bristle_stiffness <= limit * limit
    return abs(waves) <= MAX_ORBIT_WAVES and resonator and bristle


class OrbitSource(Enum):
    """Where orbits come from.

    From the curve at one lead, from such a curve combined from a series over leads, from that
    series where the lead drifts, or from Newton's method each time.
    """

    CURVE = auto()
    COMBINED = auto()
    SERIES = auto()
    SEARCH = auto()


def orbit_source_of(orbit: OrbitState, device: Device, *, drifts: bool) -> OrbitSource:
    """The source for a device at the leads that were visited; `drifts` is whether the lead does."""
    lifts = device.normal_amplitude > device.normal_preload
    many = orbit.leads.visits > MAX_LEADS
    if orbit.tunings >= MAX_TUNINGS or ((drifts or many) and lifts):
        return OrbitSource.SEARCH
    if drifts:
        return OrbitSource.SERIES
    return OrbitSource.COMBINED if many else OrbitSource.CURVE


MISSED_TURNS = 100.0
"""Turns for which motion is resolved where there is no orbit, until one is looked for again."""


SEARCH_MAPS = 300.0
"""Period maps for searches up to which a step has them, however short it is."""

SEARCH_MAPS_IN_TURN = 20.0
"""Further ones for each turn of the drive in it: where they take more, motion is resolved."""


@dataclass(slots=True)
class Unknown:
    """The drive `angle` [rad] for which motion has to be resolved instead; 0 where all is known."""

    angle: float = 0.0


@dataclass(frozen=True, slots=True)
class OrbitRide:
    """The ride from `lead` [rad] on.

    `searches` says that each orbit costs a search. Where there is none, or where the orbits of the
    ride take more than `max_maps`, they are `unknown`: for outputs averages of `first` order serve
    there, under a `load` [N].
    """

    map: PeriodMap
    slow: SlowPhase
    turns: int
    lead: float
    table: OrbitTable
    searches: bool
    first: SlowFriction
    load: float
    max_maps: int
    unknown: Unknown = field(default_factory=Unknown)

    def within(self, duration: float) -> OrbitRide:
        """The ride over `duration` [s], in which searches may take so many maps a turn."""
        turns = self.map.held.plant.drive_frequency * duration / tau
        if not self.searches or turns > self.max_maps:
            return self
        maps = int(SEARCH_MAPS + SEARCH_MAPS_IN_TURN * turns)
        return replace(self, max_maps=min(self.max_maps, maps))

    def lead_at(self, t: float) -> float:
        """The lead [rad] at time `t` [s] from the beginning."""
        return self.lead + self.slow.drift * t

    def acceleration(self, t: float, velocity: float) -> float:
        """Slow acceleration [m/s^2] at time `t` [s] and a slow velocity [m/s].

        Not a number where the orbit is unknown: that ends an integration.
        """
        found = self.table.friction(self.lead_at(t), velocity)
        if found is None or self.table.maps > self.max_maps:
            turns = MISSED_TURNS if found is None else MAX_STEP_MAPS
            self.unknown.angle = tau * turns
            return nan
        friction, factor = found
        return -factor * (friction + self.load) / self.map.held.plant.total_mass

    def point(self, t: float, velocity: float) -> OrbitPoint:
        """The orbit at that time and velocity.

        Without an orbit it is the vibration under averaged friction.
        """
        found = self.table.point(self.lead_at(t), velocity)
        if found is not None:
            return found
        self.unknown.angle = tau * MISSED_TURNS
        scales = self.map
        direction = FORWARD if velocity >= 0.0 else BACKWARD
        frequency = scales.held.plant.drive_frequency
        phase = scales.section_phase(direction)
        displacement, rate = steady_swing(scales.fast.resonator, phase, frequency)
        bristle = direction * scales.held.bristle.coefficient if scales.states > 3 else 0.0
        friction = self.first.at(t, velocity)
        of = Quantities(friction, 1.0, 0.0, 0.0, displacement, rate, bristle)
        return OrbitPoint(of, direction, found=False)

    def theta(self, t: float, theta: float, chi: float) -> float:
        """Drive phase [rad] over all turns of the orbit, for one within a turn.

        It is that at which the normal phase `chi` [rad] fits the lead.
        """
        best, phase, lead = inf, theta, self.lead_at(t)
        for turn in range(self.turns):
            there = theta + tau * turn
            miss = abs(remainder(chi - lead - self.slow.waves * there, tau))
            if miss < best:
                best, phase = miss, there
        return phase

    def moment(
        self, t: float, theta: float, velocity: float, centre: float
    ) -> tuple[Moment, OrbitPoint] | None:
        """The moment on the orbit with this slow velocity [m/s] and slow centre [m].

        `theta` [rad] goes over all turns of the orbit, whose phases those of the moment are. None
        where the motion fails.
        """
        scales, plant = self.map, self.map.held.plant
        w, share, drive = plant.drive_frequency, plant.mass_fraction, scales.fast.pair_velocity
        lead, point = self.lead_at(t), self.point(t, velocity)
        of, start = point.of, scales.section_phase(point.direction)
        slider = velocity + of.offset - share * of.rate - drive * cos(start)
        state = State(slider, of.displacement, of.rate)
        section = scales.enter(lead, start, state, of.bristle)
        period = tau * scales.turns
        ahead = theta - start
        ahead -= period * floor(ahead / period)
        duration = ahead / w
        moment: Moment | None = section
        if duration > 0.0:
            moment = scales.advance(lead, -of.friction, section, duration)
        if moment is None:
            return None
        moment.position += (
            centre + of.way - share * of.displacement - drive / w * sin(start) - velocity * duration
        )
        return moment, point


def begin_ride(
    device: Device, ratio: float, orbit: OrbitState, lead: float, first: SlowFriction, load: float
) -> OrbitRide:
    """The ride of a device from a state beside the moment and a `lead` [rad] on."""
    slow = orbit_phase_of(device, ratio)
    turns, waves, drift = slow.turns or 1, slow.waves, slow.drift
    source = orbit_source_of(orbit, device, drifts=drift != 0.0)
    if source == OrbitSource.SERIES and not orbit.paid.has_series_of(waves):
        source = OrbitSource.SEARCH
    period_map = orbit_map(device, waves, turns)
    searches = source == OrbitSource.SEARCH
    table: OrbitTable
    if searches:
        table = OrbitSearch(period_map)
    elif source == OrbitSource.SERIES:
        table = series_table(device, waves, turns)
    elif source == OrbitSource.COMBINED:
        table = combined_table(device, waves, turns, lead)
    else:
        table = curve_table(device, waves, turns, lead)
    max_maps = int(MAX_STEP_MAPS / (turns * (1.0 + abs(ratio) / MAP_WAVES)))
    return OrbitRide(period_map, slow, turns, lead, table, searches, first, load, max_maps)
