"""The slow velocity over a time: integrated, or settled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, isfinite

from .budget import Budget
from .dormand_prince import Reached, integrate
from .settling import Acceleration, settled

FIRST_STEP = 0.1
"""Step tried first, as a share of the time in which friction changes the fast velocity."""

SETTLING = 100.0
"""What must be left, in first steps, for the motion to settle."""

BEAT_SHARE = 0.125
"""Part of a beat that a step may have: its stages then see all phases of the normal load."""

MIN_SHARE = 1e-9
"""Part of a beat up to which a kink ahead counts as the one just passed."""

BLOCK = 16
"""Steps before each of which it may turn out that the motion has settled."""

STEPS = "steps of averaged motion"


@dataclass(frozen=True, slots=True)
class SlowPass:
    """How to pass.

    The `fast` velocity [m/s], the error per step [m/s], the `step` [s] tried first,
    whether the motion may settle, and `max_steps`, which a whole budget buys. The acceleration
    repeats after a `beat` [s], and is smooth for `to_kink(t)` [s] from `t` [s] on.
    """

    acceleration: Acceleration
    fast: float
    tolerance: float
    step: float
    may_settle: bool
    max_steps: int
    beat: float = inf
    to_kink: Callable[[float], float] | None = None

    def reach(self, end: float, now: Reached, budget: Budget) -> Reached:
        """What is reached at time `end` [s]; motion that settles takes few steps, however long.

        Raises Refusal where that takes more than the budget has.
        """
        allowed, before = budget.left(self.max_steps), now.tried
        # No step is longer than a share of a beat: too many of them are refused before the first.
        furthest = allowed * (BEAT_SHARE * self.beat)
        if not self.may_settle and end - now.t > furthest:
            raise budget.refusal(now.t + furthest, self.max_steps, STEPS)
        while now.t < end and isfinite(now.velocity):
            room = allowed - (now.tried - before)
            if room <= 0:
                raise budget.refusal(now.t, self.max_steps, STEPS)
            if self.may_settle and end - now.t > SETTLING * self.step:
                at_rest = settled(self.acceleration, self.fast, end, now)
                if at_rest is not None:
                    now = at_rest
                    break
            smooth, block = self._end_of_smoothness(now.t, end), min(room, BLOCK)
            tried, longest = now.tried, BEAT_SHARE * self.beat
            now = integrate(self.acceleration, now, smooth, self.tolerance, block, longest)
            # A time too short for a step counts as one, so that the loop ends.
            now = now._replace(tried=max(now.tried, tried + 1))
        budget.spend(now.tried - before, self.max_steps)
        return now

    def _end_of_smoothness(self, t: float, end: float) -> float:
        """The next kink of the acceleration after `t`, or `end` [s]."""
        if self.to_kink is None:
            return end
        return min(end, t + max(self.to_kink(t), MIN_SHARE * self.beat))


def first_step(fast: float, mass: float, strongest: float, duration: float) -> float:
    """The step [s] to try first.

    It is a share of the time in which the `strongest` force [N] changes the fast velocity [m/s] of
    a mass [kg]; without force all the `duration` [s].
    """
    return FIRST_STEP * fast * mass / strongest if strongest > 0.0 else duration
