"""The period map: resolved motion of the full device, seen once in each period of the normal load.

It is seen at a section: the phase of the drive at which the vibration is fastest forward, where no
reversal comes unless sliding is about to end reversing at all. There the slow state is V = W and
the position X, with W = X' + r_m Y' + D / (Mt w) cos(theta) and exactly Mt W' = -F - load. The fast
state is the resonator's Y and Y' and, with LuGre friction, the bristle. From period to period both
change slowly and smoothly (stroboscopic averaging: Calvo, Chartier, Murua, Sanz-Serna 2011).
"""

from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from math import cos, exp, isfinite, pi, remainder, tau

from .budget import Budget
from .contact import LIFTED, STICK
from .device import System, Vibration
from .events import advance, law_of
from .moment import Moment
from .slow_friction import full_friction

MAP_TOLERANCE = 1e-10
"""Largest tolerance of LuGre friction in a map: differences of high order amplify its error."""

Fast = Sequence[float]
"""The three fast states: Y [m], Y' [m/s], and the bristle's friction per unit load."""


class NoMapError(Exception):
    """There is no period map, or no slow manifold, or the motion leaves it."""


class PeriodMap:
    """The period map of a system of the full device under held inputs.

    The normal load repeats after `turns` turns of the drive, in `period` [s], but for a `drift`
    [rad] of its phase. `section` is the drive phase of the section [rad], `speed` the fast velocity
    v_q [m/s], `share` the change of V by full friction in a period, over v_q. An error by `scale`
    in a fast state is as large as the vibration, or changes V by v_q times `share`. `decay` is the
    largest factor by which a transient decays in a period.
    """

    def __init__(self, system: System, fast: Vibration, max_turns: int) -> None:
        """Raises NoMapError without vibration, or where transients do not decay."""
        device, w = system.device, system.drive_frequency
        self.tolerance = device.tolerance
        tight = replace(device, tolerance=min(device.tolerance, MAP_TOLERANCE))
        self.system, self.vibration = System(tight, system.inputs), fast
        self.turns, self.drift = _turns_to_repeat_best(system, max_turns)
        self.period, self.section = tau * self.turns / w, (fast.lag + pi) % tau
        self.speed = fast.velocity
        if not fast.velocity > 0.0:
            raise NoMapError
        self.share = full_friction(device) * self.period / (device.total_mass * self.speed)
        swing = abs(fast.resonator) or self.speed / w
        if system.mass_fraction > 0.0:
            swing = min(swing, self.speed / (system.mass_fraction * w))
        self.scale, self.kept = (swing, swing * w, 1.0), 0.0
        self.decay = exp(system.slip.eigenvalues[0].real * self.period)
        if device.friction_law == 1:
            mu, path = device.friction_coefficient, 4.0 * self.turns * self.speed / w
            self.scale = (swing, swing * w, mu)
            self.kept = exp(-device.bristle_stiffness * path / mu)
            self.decay = max(self.decay, self.kept)
        (a, b), (c, d) = system.slip.free_map(self.period)
        self._matrix = (a - 1.0, b, c, d - 1.0)
        self._determinant = (a - 1.0) * (d - 1.0) - b * c
        if not (self.decay < 1.0 and self._determinant != 0.0):
            raise NoMapError

    def under_load(self, load: float) -> "PeriodMap":
        """The same under another load [N]."""
        other = copy(self)
        other.system = System(self.system.device, replace(self.system.inputs, load=load))
        return other

    def slow_velocity(self, now: Moment) -> float:
        """The slow velocity V [m/s] at a moment, but for its change within a period."""
        carried = now.velocity + self.system.mass_fraction * now.rate
        return carried + self.vibration.pair_velocity * cos(now.theta)

    def place(self, begin: Moment, velocity: float, fast: Fast, periods: float = 0.0) -> Moment:
        """The moment at V [m/s] and fast states at the section, some periods after `begin`."""
        placed = begin.copied()
        placed.theta = self.section
        placed.psi = (begin.psi + remainder(self.drift * periods, tau)) % tau
        placed.displacement, placed.rate, placed.bristle = fast
        vibrating = self.vibration.pair_velocity * cos(self.section)
        placed.velocity = velocity - vibrating - self.system.mass_fraction * placed.rate
        placed.mode = law_of(self.system).mode(self.system, placed)
        placed.sliding = STICK if placed.mode == LIFTED else placed.mode
        return placed

    def sections(self, now: Moment, count: int, budget: Budget) -> tuple[list[Moment], list[int]]:
        """The moments at the section in `count` periods, `now` first, and all contact modes.

        Raises NoMapError where the motion leaves the range of floating point, and Refusal where the
        budget is spent.
        """
        sections, modes = [now], [now.mode]
        for _ in range(count):
            now = advance(self.system, now, self.period, budget, modes)
            now.theta = self.section
            sections.append(now)
        if not isfinite(self.slow_velocity(now) + now.position + sum(fast_of(now))):
            raise NoMapError
        return sections, modes

    def resolvent(self, times: int, change: Fast) -> Fast:
        """The change of the fast state that undoes their differences of the order `times`.

        By the inverse of the map without friction, less 1; a bristle forgets within a period.
        """
        y, u, bristle = change
        a, b, c, d = self._matrix
        for _ in range(times):
            y, u = (d * y - b * u) / self._determinant, (a * u - c * y) / self._determinant
            bristle /= self.kept - 1.0
        return y, u, bristle

    def size(self, change: Fast) -> float:
        """Size of a change of the fast state, over the scales."""
        return max(abs(part) / scale for part, scale in zip(change, self.scale, strict=True))


def fast_of(now: Moment) -> Fast:
    """The fast states of a moment."""
    return now.displacement, now.rate, now.bristle


def _turns_to_repeat_best(system: System, max_turns: int) -> tuple[int, float]:
    """Smallest number of turns, up to `max_turns`, after which the load repeats best.

    One more turn must halve its drift [rad] at least.
    """
    ratio = system.normal_frequency / system.drive_frequency
    best, drift = 1, tau * (ratio - round(ratio))
    for turns in range(2, max_turns + 1):
        off = tau * (turns * ratio - round(turns * ratio))
        if abs(off) < 0.5 * abs(drift):
            best, drift = turns, off
    return (best, drift) if system.device.normal_amplitude > 0.0 else (1, 0.0)
