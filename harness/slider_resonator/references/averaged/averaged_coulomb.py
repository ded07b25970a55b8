"""The averaged friction of Coulomb, at any integer ratio of the two frequencies.

Velocities are in units of ``x0 w0`` and forces in units of the mean friction ``faces mu N0``.
``strength`` is q > 0, ``amplitude_ratio`` alpha, ``ratio`` the frequency of the normal load over
that of the drive, and ``phase`` the phase of the normal load when the tangential force passes
through zero upward. The contact may lift (``amplitude_ratio`` > 1).
"""

import math

from slider_resonator.references.averaged.vibrating_contact import (
    closed_spans,
    mean_load,
    turns_until_repeat,
)


def mean_friction(
    velocity: float, strength: float, amplitude_ratio: float, phase: float, ratio: float = 1.0
) -> float:
    """Return the friction averaged over the fast motion, the bracket of (4) for any ratio.

    The fast velocity is ``velocity - strength cos(theta)``; at and beyond ``strength`` friction no
    longer changes sign. An integer ratio n gives
    ``1 - 2 theta / pi - 2 alpha / (n pi) sin(n theta) sin(phase)`` for a contact that never lifts;
    where the load never repeats (see `turns_until_repeat`) only its mean counts.
    """
    angle = math.acos(max(-1.0, min(1.0, velocity / strength)))
    slide = 1.0 - 2.0 * angle / math.pi
    turns = turns_until_repeat(amplitude_ratio, ratio)
    if turns == 0 or ratio == 0.0:
        return slide * mean_load(1.0, amplitude_ratio, phase, ratio)
    if amplitude_ratio > 1.0:
        total = 0.0
        for turn in range(turns):
            begin = 2.0 * math.pi * turn
            there, back, again = begin - angle, begin + angle, begin + 2.0 * math.pi - angle
            total += _load_integral(back, again, amplitude_ratio, phase, ratio)
            total -= _load_integral(there, back, amplitude_ratio, phase, ratio)
        return total / (2.0 * math.pi * turns)
    share = 2.0 * amplitude_ratio / (ratio * math.pi)
    return slide - share * math.sin(ratio * angle) * math.sin(phase)


def _load_integral(
    start: float, end: float, amplitude_ratio: float, phase: float, ratio: float
) -> float:
    """Return the integral of the load over theta; the contact may lift, the ratio is not 0."""
    return sum(
        (last - first)
        - amplitude_ratio
        / ratio
        * (math.cos(ratio * last + phase) - math.cos(ratio * first + phase))
        for first, last in closed_spans(start, end, amplitude_ratio, phase, ratio)
    )
