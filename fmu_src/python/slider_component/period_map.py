"""The period map: resolved motion of the full device, seen once in each period of the normal load.

It is seen at a section: the phase of the drive at which the vibration is fastest forward, where no
reversal comes unless sliding is about to end reversing at all. The slow state is the position X and
the slow velocity V = X' + r_m Y' + D / (Mt w) cos(theta), which friction and load alone change. The
fast state is the resonator's Y and Y' and, with LuGre friction, the bristle. From period to period
both change slowly and smoothly (stroboscopic averaging: Calvo, Chartier, Murua, Sanz-Serna 2011).
"""

from cmath import exp
from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from math import isfinite, pi, remainder, tau

from .contact import LIFTED, STICK, turns_to_repeat
from .device import System, Vibration
from .moment import Moment
from .resolved import Resolved
from .slow_equation import NoRatesError
from .values import Budget

NEAR = 0.014
"""Largest distance of q times the frequency ratio from an integer, times q, at which a load counts
as repeating after q turns."""

Numbers = Sequence[float]
"""The fast states Y [m], Y' [m/s] and, with LuGre friction, that of the bristle per unit load; at a
section with V [m/s] before and X [m] behind."""


class PeriodMap:
    """The period map of a system of the full device under held inputs.

    The normal load repeats after some turns of the drive, in `period` [s], but for a `drift` [rad]
    of its phase. `section` is the drive phase of the section [rad], `speed` the fast velocity v_q
    [m/s], `share` the change of V by full friction in a period, over v_q. By its `scale` an error
    of a fast state is as large as the vibration, or changes V by v_q times `share`.
    """

    def __init__(self, system: System, max_turns: int) -> None:
        """Raises NoRatesError without vibration, where transients do not decay, and where the load
        is far from repeating after up to `max_turns` turns of the drive; Refusal at resonance.
        """
        device, w = system.device, system.drive_frequency
        self.vibration = fast = Vibration(device)
        self.tolerance, self.speed = device.tolerance, fast.velocity
        self._bends = device.friction_law == 1
        # Differences of high order amplify the error of LuGre friction in a map.
        tight = replace(device, tolerance=min(device.tolerance, 1e-10))
        self.motion = Resolved(System(tight, system.inputs))
        ratio = system.inputs.frequency_ratio if device.normal_amplitude > 0.0 else 0.0
        turns = turns_to_repeat(ratio, max_turns, NEAR)
        if turns is None or not self.speed > 0.0:
            raise NoRatesError
        self.drift = tau * (turns * ratio - round(turns * ratio))
        self.period, self.section = tau * turns / w, (fast.lag + pi) % tau
        self.share = device.full_friction * self.period / (device.total_mass * self.speed)
        swing = abs(fast.resonator) or self.speed / w
        if device.resonator_mass > 0.0:
            swing = min(swing, self.speed / (device.mass_fraction * w))
        mu, path = device.friction_coefficient, 4.0 * turns * self.speed / w
        fast_scale = [swing, swing * w, *([mu] if self._bends else [])]
        self.scale = [self.speed, *fast_scale, self.speed * self.period]
        self._kept = abs(exp(-device.bristle_stiffness * path / mu)) if self._bends else 0.0
        if not max(self._kept, abs(exp(system.slip.eigenvalues[0] * self.period))) < 1.0:
            raise NoRatesError

    def under_load(self, load: float) -> "PeriodMap":
        """The same under another load [N]."""
        other, system = copy(self), self.motion.system
        other.motion = Resolved(System(system.device, replace(system.inputs, load=load)))
        return other

    def numbers(self, now: Moment) -> Numbers:
        """V, the fast states and X at the section."""
        velocity = now.velocity + self.vibration.ahead(now.theta, now.rate)
        bristle = [now.bristle] if self._bends else []
        return [velocity, now.displacement, now.rate, *bristle, now.position]

    def place(self, begin: Moment, velocity: float, fast: Numbers, periods: float = 0.0) -> Moment:
        """The moment at V [m/s] and fast states at the section, some periods after `begin`."""
        placed = begin.copied()
        placed.theta = self.section
        placed.psi = (begin.psi + remainder(self.drift * periods, tau)) % tau
        placed.displacement, placed.rate, *bristle = fast
        placed.bristle = sum(bristle)
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

    def resolvent(self, times: int, change: Numbers) -> Numbers:
        """The change of the fast state that undoes their differences of the order `times`.

        By the inverse of the map without friction, less 1, which is a number for each exponential
        of free motion. A bristle forgets within a period.
        """
        y, u, *bristle = change
        free = self.motion.system.slip.free(y, u)
        undone = [(z, a / (exp(z * self.period) - 1.0) ** times) for z, a in free]
        bent = [b / (self._kept - 1.0) ** times for b in bristle]
        return [sum(a.real for _, a in undone), sum((z * a).real for z, a in undone), *bent]
