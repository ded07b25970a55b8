"""The normal load over a turn of the drive; it is never negative.

The load is ``max(0, 1 + amplitude_ratio sin(ratio theta + phase))`` in units of the preload, theta
the angle of the drive. Angles are in rad.
"""

import math

MAX_TURNS = 4
"""Turns of the drive up to which a clipped load that repeats after them has a slow phase."""


def mean_load(preload: float, amplitude: float, phase: float, ratio: float) -> float:
    """Return the load averaged over the angles that it takes, in the unit of preload and amplitude.

    It takes all, at ratio 0 only its ``phase``. The contact may lift.
    """
    if ratio == 0.0:
        return max(0.0, preload + amplitude * math.sin(phase))
    if amplitude <= preload:
        return preload
    share = preload / amplitude
    closed = preload * (0.5 + math.asin(share) / math.pi)
    return closed + amplitude / math.pi * math.sqrt(1.0 - share**2)


def turns_until_repeat(amplitude_ratio: float, ratio: float, share: float = 1e-12) -> int:
    """Return the number of drive turns after which a load repeats in averages; 0 for none.

    A load that never lifts is a sine, which averages out over several turns: 1 for ratios next to
    an integer, else 0. A clipped load has harmonics, some of which keep step with the drive; up to
    `MAX_TURNS` turns count. ``share`` is the largest distance of the ratio times the turns from an
    integer, times the turns.
    """
    for turns in range(1, (MAX_TURNS if amplitude_ratio > 1.0 else 1) + 1):
        waves = turns * ratio
        if abs(waves - round(waves)) * turns <= share:
            return turns
    return 0


def closed_spans(
    start: float, end: float, amplitude_ratio: float, phase: float, ratio: float
) -> list[tuple[float, float]]:
    """Return the spans (from, to) of theta within ``[start, end]`` in which the contact is closed.

    They ascend.
    """
    if amplitude_ratio <= 1.0:
        return [(start, end)]
    if ratio == 0.0:
        return [(start, end)] if 1.0 + amplitude_ratio * math.sin(phase) > 0.0 else []
    before = math.asin(1.0 / amplitude_ratio)
    # By the angle of the load the contact is closed from -before to pi + before, and turns later.
    first, last = sorted((ratio * start + phase, ratio * end + phase))
    turn = math.floor((first + before) / (2.0 * math.pi))
    spans = []
    while (touchdown := 2.0 * math.pi * turn - before) < last:
        lift_off = touchdown + math.pi + 2.0 * before
        edges = ((max(first, touchdown) - phase) / ratio, (min(last, lift_off) - phase) / ratio)
        if edges[0] != edges[1] and lift_off > first:
            spans.append((min(edges), max(edges)))
        turn += 1
    return sorted(spans)
