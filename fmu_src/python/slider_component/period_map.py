"""The period map: resolved motion of the full device, seen once in each period of the normal load.

It is seen at a section: the phase of the drive at which the vibration is fastest forward, where no
reversal comes unless sliding is about to end reversing at all. The slow state is the position X and
the slow velocity V = X' + r_m Y' + D / (Mt w) cos(theta), which friction and load alone change. The
fast state is the resonator's Y and Y' and, with LuGre friction, the bristle. From period to period
both change slowly and smoothly (stroboscopic averaging: Calvo, Chartier, Murua, Sanz-Serna 2011).
"""

from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from math import exp, isfinite, pi, remainder, tau

from .budget import Budget
from .contact import LIFTED, STICK
from .device import System, Vibration, full_friction
from .moment import Moment
from .resolved import Resolved
from .slow_equation import NoRatesError
from .vibrating_load import turns_to_repeat

NEAR = 0.014
"""Largest distance of q times the frequency ratio from an integer, times q, at which a load counts
as repeating after q turns."""

MAP_TOLERANCE = 1e-10
"""Largest tolerance of LuGre friction in a map: differences of high order amplify its error."""

Numbers = Sequence[float]
"""V [m/s] and X [m] at a section, and the fast states: Y [m], Y' [m/s], and the bristle's friction
per unit load."""

Fast = Sequence[float]
"""The three fast states of these."""


class PeriodMap:
    """The period map of a system of the full device under held inputs.

    The normal load repeats after some turns of the drive, in `period` [s], but for a `drift` [rad]
    of its phase. `section` is the drive phase of the section [rad], `speed` the fast velocity v_q
    [m/s], `share` the change of V by full friction in a period, over v_q. By its `scale` an error
    of a fast state is as large as the vibration, or changes V by v_q times `share`.
    """

    def __init__(self, system: System, max_turns: int) -> None:
        """Raises NoRatesError without vibration, where transients do not decay, and where the load
        is far from repeating after up to `max_turns` turns of the drive.

        Raises Refusal where undamped resonance leaves no steady vibration.
        """
        device, w = system.device, system.drive_frequency
        self.vibration = fast = Vibration(device)
        self.tolerance, self.speed = device.tolerance, fast.velocity
        tight = replace(device, tolerance=min(device.tolerance, MAP_TOLERANCE))
        self.motion = Resolved(System(tight, system.inputs))
        ratio = system.inputs.frequency_ratio if device.normal_amplitude > 0.0 else 0.0
        turns = turns_to_repeat(ratio, max_turns, NEAR)
        if turns is None or not self.speed > 0.0:
            raise NoRatesError
        self.drift = tau * (turns * ratio - round(turns * ratio))
        self.period, self.section = tau * turns / w, (fast.lag + pi) % tau
        self.share = full_friction(device) * self.period / (device.total_mass * self.speed)
        swing = abs(fast.resonator) or self.speed / w
        if device.resonator_mass > 0.0:
            swing = min(swing, self.speed / (device.mass_fraction * w))
        mu, path = device.friction_coefficient, 4.0 * turns * self.speed / w
        bends = device.friction_law == 1
        self.scale = self.speed, self.speed * self.period, swing, swing * w, mu if bends else 1.0
        self._kept = exp(-device.bristle_stiffness * path / mu) if bends else 0.0
        self._free_map = (a, b), (c, d) = system.slip.free_map(self.period)
        self._determinant = (a - 1.0) * (d - 1.0) - b * c
        decay = max(self._kept, exp(system.slip.eigenvalues[0].real * self.period))
        if not (decay < 1.0 and self._determinant != 0.0):
            raise NoRatesError

    def under_load(self, load: float) -> "PeriodMap":
        """The same under another load [N]."""
        other, system = copy(self), self.motion.system
        other.motion = Resolved(System(system.device, replace(system.inputs, load=load)))
        return other

    def numbers(self, now: Moment) -> Numbers:
        """V, X and the fast states at the section."""
        velocity = now.velocity + self.vibration.ahead(now.theta, now.rate)
        return velocity, now.position, now.displacement, now.rate, now.bristle

    def place(self, begin: Moment, velocity: float, fast: Fast, periods: float = 0.0) -> Moment:
        """The moment at V [m/s] and fast states at the section, some periods after `begin`."""
        placed = begin.copied()
        placed.theta = self.section
        placed.psi = (begin.psi + remainder(self.drift * periods, tau)) % tau
        placed.displacement, placed.rate, placed.bristle = fast
        placed.velocity = velocity - self.vibration.ahead(self.section, placed.rate)
        placed.mode = self.motion.mode(placed)
        placed.sliding = STICK if placed.mode == LIFTED else placed.mode
        return placed

    def sections(self, now: Moment, count: int, budget: Budget) -> tuple[list[Moment], list[int]]:
        """The moments at the section in `count` periods, `now` first, and all contact modes.

        Raises NoRatesError beyond the range of floating point, and Refusal beyond the budget.
        """
        sections, modes = [now], [now.mode]
        for _ in range(count):
            now = self.motion.resolve(now, self.period, budget, modes)
            now.theta = self.section
            sections.append(now)
        if not all(map(isfinite, self.numbers(now))):
            raise NoRatesError
        return sections, modes

    def resolvent(self, times: int, change: Fast) -> Fast:
        """The change of the fast state that undoes their differences of the order `times`.

        By the inverse of the map without friction, less 1; a bristle forgets within a period.
        """
        y, u, bristle = change
        (a, b), (c, d) = self._free_map
        for _ in range(times):
            y, u = (d - 1.0) * y - b * u, (a - 1.0) * u - c * y
            y, u = y / self._determinant, u / self._determinant
            bristle /= self._kept - 1.0
        return y, u, bristle

    def size(self, change: Fast) -> float:
        """Size of a change of the fast state, over the scales."""
        return max(abs(part) / scale for part, scale in zip(change, self.scale[2:], strict=True))
