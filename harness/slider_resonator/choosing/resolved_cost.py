"""The cost of resolved motion, from counts alone: by drive period, friction law and fidelity."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, log10

from slider_resonator.choosing.candidate import COULOMB, LUGRE, Model
from slider_resonator.choosing.plan import Plan
from slider_resonator.choosing.scales import BREAKS_LOOSE, NEAR_AN_INTEGER, Scales

FORGETS = 6.0
"""Memories of the resonator, or relaxation times of the slow motion, until it repeats itself."""


@dataclass(frozen=True)
class ResolvedPrices:
    """Seconds of a drive period at fidelity 1 or 2, and what they are besides.

    `sliding` is for a period that repeats the one before, `unsettled` is added for one in which the
    resonator still swings, `lifting` where the contact lifts or the normal load turns slowly,
    `damped` where the resonator hardly oscillates; `sticking` is that where friction stops the
    slider in each. Of LuGre friction `digit` is for each of the tolerance in such a period, `turn`
    for an oscillation on the bristle of a slider that sticks, and `start` is once.
    """

    sliding: float
    unsettled: float
    sticking: float
    lifting: float = 0.0
    damped: float = 0.0
    digit: float = 0.0
    turn: float = 0.0
    start: float = 0.0


RESOLVED = {
    (1, COULOMB): ResolvedPrices(0.435e-6, 0.0, 0.75e-6, 0.22e-6, 0.7e-6),
    (2, COULOMB): ResolvedPrices(0.46e-6, 0.4e-6, 1.6e-6, 0.26e-6, 1.4e-6),
    (1, LUGRE): ResolvedPrices(0.0, 0.0, 2.3e-6, 0.1e-6, 0.7e-6, 0.14e-6, 3.8e-6),
    (2, LUGRE): ResolvedPrices(0.0, 2e-6, 2.2e-6, 0.16e-6, 1.4e-6, 0.13e-6, 3.6e-6, 27e-6),
}
"""By fidelity and friction law. LuGre friction that slides is in `BRISTLES`."""


@dataclass(frozen=True)
class BristlePrices:
    """Seconds of a drive period of sliding LuGre friction at fidelity 2, where kappa is below `to`.

    `digit` is for each digit of the tolerance. Bristles that bend in part of a period are followed
    by series, stiffer ones by a panel of Gauss nodes.
    """

    to: float
    period: float
    digit: float


BRISTLES = (
    BristlePrices(0.3, 3.5e-6, 0.0),
    BristlePrices(3.0, 3.1e-6, 0.28e-6),
    BristlePrices(15.0, 1.75e-6, 0.6e-6),
    BristlePrices(40.0, 0.7e-6, 0.63e-6),
    BristlePrices(300.0, 1.25e-6, 0.175e-6),
    BristlePrices(1e4, 1.2e-6, 0.08e-6),
    BristlePrices(inf, 0.17e-6, 0.155e-6),
)
SERIES = 15.0
"""Largest kappa of bristles that series follow. Stiffer ones cost as much while an input
grows along a line: panels are for inputs that are held."""
FIRST_FIDELITY = 0.95
"""Share of it at fidelity 1."""
CHIRP = 2.4e-6
"""Seconds of a drive period in which the frequency ratio grows along a line, besides."""


NEVER_SLIDES, STUCK = 1.5, 0.02e-6
"""Friction over vibration that stops the slider for good, and seconds of such a drive period."""
HARDLY_OSCILLATES = 0.85
"""Damping ratio of the sliding resonator from which on its closed forms cost more."""
SELDOM, ALWAYS, MIN_SHARE = 0.35, 0.8, 0.2
"""Friction over vibration at which the slider hardly sticks and does throughout, and the least
share of the time, before it is squared."""


def period_cost(model: Model, tolerance: float, scales: Scales) -> float:
    """Return the cost (s) of a drive period at fidelity 1 or 2, once the resonator has settled."""
    prices = RESOLVED[model.fidelity, model.friction_law]
    if model.friction_law == COULOMB and (scales.slowness or 0.0) >= NEVER_SLIDES:
        return STUCK
    sticks = scales.slowness is not None and scales.slowness >= BREAKS_LOOSE
    cost = prices.sticking if sticks else prices.sliding
    if scales.lifts or 0.0 < abs(scales.ratio) < NEAR_AN_INTEGER:
        cost += prices.lifting
    if scales.damping >= HARDLY_OSCILLATES:
        cost += prices.damped
    if model.friction_law == COULOMB:
        return cost
    if not sticks:
        return cost + _bristle_cost(model, tolerance, scales.kappa or 0.0)
    digits = -log10(tolerance)
    turns = scales.bristle_turns * _sticking_share(scales)
    return cost + prices.digit * digits + prices.turn * turns


def _bristle_cost(model: Model, tolerance: float, kappa: float) -> float:
    """Return what a sliding bristle adds to the cost (s) of a drive period."""
    prices = next(prices for prices in BRISTLES if kappa < prices.to)
    share = FIRST_FIDELITY if model.fidelity == 1 else 1.0
    return share * (prices.period - prices.digit * log10(tolerance))


def _sticking_share(scales: Scales) -> float:
    """Return the share of the time that the slider spends on its bristle, where it has turns."""
    if scales.slowness is None:
        return 1.0
    share = (scales.slowness - SELDOM) / (ALWAYS - SELDOM)
    return min(1.0, max(MIN_SHARE, share) ** 2)


def resolved_cost(
    model: Model, tolerance: float, scales: Scales, plan: Plan, periods: float
) -> float:
    """Return the cost (s) of so many drive periods of a run."""
    prices = RESOLVED[model.fidelity, model.friction_law]
    unsettled = min(periods, FORGETS * scales.memory * (1.0 + plan.shakes))
    share = periods * scales.period / plan.duration
    cost = prices.start + prices.unsettled * unsettled + CHIRP * share * plan.chirped
    if model.friction_law == LUGRE:
        kappas = scales.kappa or 0.0, min(scales.kappa or 0.0, 0.99 * SERIES)
        panels, series = (_bristle_cost(model, tolerance, kappa) for kappa in kappas)
        cost += share * plan.ramped * max(0.0, series - panels)
    return cost + periods * period_cost(model, tolerance, scales)
