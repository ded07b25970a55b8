"""The cost of a run, from counts alone, so that the same scene always has the same answer.

The counts are communication steps, changes of the inputs, drive periods, and for averaged motion
beats and relaxation times; their weights were fitted to the CPU time of the native FMU behind fmpy
(`python -m tests.harness.studies.choose.pricing` measures them again). A model of cost decides
between candidates; the seconds of another machine are another multiple of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log10

from slider_resonator.studies.choose.candidate import COULOMB, LUGRE, Candidate, Model
from slider_resonator.studies.choose.plan import Plan
from slider_resonator.studies.choose.scales import BREAKS_LOOSE, Scales

RUN = 40e-6
"""Seconds of a run besides its steps: the start of the FMU, the record, one state."""
STEP = 2.6e-6
"""Seconds for a communication step through fmpy, with some outputs read."""
CHANGE = 1.8e-6
"""Seconds to set inputs that have changed."""
FORGETS = 6.0
"""Memories of the resonator, or relaxation times of the slow motion, until it repeats itself."""


@dataclass(frozen=True)
class ResolvedPrices:
    """Seconds of a drive period at fidelity 1 or 2, and what they are besides.

    `sliding` is for a period that repeats the one before, `unsettled` is added for one in which the
    resonator still swings; `sticking` is that where friction stops the slider in each. Of LuGre
    friction `stiffer` is for each decade of kappa from a tenth to a hundred, `digit` for each of
    the tolerance, `turn` for an oscillation on the bristle of a slider that sticks, and `start` is
    once.
    """

    sliding: float
    unsettled: float
    sticking: float
    stiffer: float = 0.0
    digit: float = 0.0
    turn: float = 0.0
    start: float = 0.0


RESOLVED = {
    (1, COULOMB): ResolvedPrices(0.38e-6, 0.16e-6, 0.7e-6),
    (2, COULOMB): ResolvedPrices(0.45e-6, 0.55e-6, 1.6e-6),
    (1, LUGRE): ResolvedPrices(1.3e-6, 0.0, 0.9e-6, 0.25e-6, 0.19e-6, 2.1e-6),
    (2, LUGRE): ResolvedPrices(1.2e-6, 1.5e-6, 1.3e-6, 0.44e-6, 0.21e-6, 2.4e-6, 80e-6),
}
"""By fidelity and friction law."""


@dataclass(frozen=True)
class AveragedPrices:
    """Seconds of averaged motion.

    `step` is added to each communication step, `transient` is for each relaxation time after a
    change, until the motion has settled; `relaxation` is for each where beats keep it moving, and
    `beat` for each of these. Of second order `start` is for the first orbits and `lead` for those
    after each change of phase or frequency ratio, and the first `resolved` memories of the
    resonator cost what resolved motion does.
    """

    step: float
    transient: float
    relaxation: float
    beat: float
    start: float = 0.0
    lead: float = 0.0
    resolved: float = 0.0


AVERAGED = {
    (1, COULOMB, False): AveragedPrices(0.4e-6, 2.4e-6, 1.5e-6, 0.5e-6),
    (1, COULOMB, True): AveragedPrices(0.4e-6, 2.4e-6, 1.5e-6, 6e-6),
    (1, LUGRE, False): AveragedPrices(0.4e-6, 2.6e-6, 1.9e-6, 15e-6),
    (1, LUGRE, True): AveragedPrices(60e-6, 0.6e-3, 1.9e-6, 2.2e-3),
    (2, COULOMB, False): AveragedPrices(5e-6, 5e-6, 1e-6, 130e-6, 0.1e-3, 3e-3, 16.0),
    (2, COULOMB, True): AveragedPrices(5e-6, 5e-6, 1e-6, 1.3e-3, 0.2e-3, 3e-3, 16.0),
    (2, LUGRE, False): AveragedPrices(15e-6, 10e-6, 2e-6, 0.4e-3, 2e-3, 2e-3, 16.0),
    (2, LUGRE, True): AveragedPrices(15e-6, 20e-6, 2e-6, 2.2e-3, 4e-3, 4e-3, 16.0),
}
"""By averaging order, friction law and whether the contact lifts: then the mean friction of a
bristle is integrated. An order is chosen from once it has its rows."""
AVERAGING_ORDERS = tuple(sorted({order for order, _, _ in AVERAGED}))
NEVER_SLIDES, STUCK = 1.5, 0.02e-6
"""Friction over vibration that stops the slider for good, and seconds of such a drive period."""
OUTPUT = {COULOMB: 13e-6, LUGRE: 60e-6}
"""Seconds to start the FMU and read the steady velocity or the blocking force of the theory."""
SEARCH = 60e-6
"""Seconds of a search by shooting besides its drive periods."""
SEARCH_PERIOD = {COULOMB: 16e-6, LUGRE: 34e-6}
"""Seconds to start, read and evaluate a drive period of a search; a bristle takes more readings."""
MAX_DECADES = 3.0
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
    if model.friction_law == COULOMB:
        return cost
    if scales.kappa and not sticks:
        cost += prices.stiffer * min(max(log10(scales.kappa) + 1.0, 0.0), MAX_DECADES)
    turns = scales.bristle_turns * _sticking_share(scales)
    return cost + prices.digit * -log10(tolerance) + prices.turn * turns


def _sticking_share(scales: Scales) -> float:
    """Return the share of the time that the slider spends on its bristle, where it has turns."""
    if scales.slowness is None:
        return 1.0
    share = (scales.slowness - SELDOM) / (ALWAYS - SELDOM)
    return min(1.0, max(MIN_SHARE, share) ** 2)


def run_cost(candidate: Candidate, scales: Scales, plan: Plan) -> float:
    """Return the cost (s) of a run."""
    cost = RUN + STEP * plan.steps + CHANGE * plan.settings
    model = candidate.model
    if model.fidelity == 0:
        cost += _preparation_cost(candidate, scales, plan)
        return cost + _averaged_cost(model, scales, plan)
    prices = RESOLVED[model.fidelity, model.friction_law]
    periods = plan.duration / scales.period
    unsettled = min(periods, FORGETS * scales.memory * (1.0 + len(plan.kicks)))
    cost += prices.start + prices.unsettled * unsettled
    return cost + periods * period_cost(model, candidate.tolerance, scales)


def _averaged_prices(model: Model, scales: Scales) -> AveragedPrices:
    lifts = scales.lifts and (scales.detuning == 0.0 or scales.beat > 0.0)
    return AVERAGED[model.averaging_order or 1, model.friction_law, lifts]


def _preparation_cost(candidate: Candidate, scales: Scales, plan: Plan) -> float:
    """Return the cost (s) of the resolved start of second-order averages, and of their orbits."""
    model, prices = candidate.model, _averaged_prices(candidate.model, scales)
    if not prices.resolved:
        return 0.0
    full = Model(2, model.friction_law)
    each = period_cost(full, candidate.tolerance, scales)
    each += RESOLVED[2, model.friction_law].unsettled
    resolved = min(plan.duration / scales.period, prices.resolved * scales.memory)
    return prices.start + prices.lead * len(plan.led) + each * resolved


def _averaged_cost(model: Model, scales: Scales, plan: Plan) -> float:
    prices = _averaged_prices(model, scales)
    beats, relaxations = scales.beat * plan.duration, plan.duration / scales.relaxation
    cost = prices.step * plan.steps + prices.beat * beats
    if beats:
        cost += prices.relaxation * relaxations
    starts = 1 + len(plan.kicks)
    return cost + prices.transient * starts * min(relaxations / starts, FORGETS)


def search_cost(model: Model, tolerance: float, periods: int, scales: Scales) -> float:
    """Return the cost (s) of a search by shooting over that number of drive periods in total.

    At fidelity 0 it is one initialisation: the outputs are the averaged theory.
    """
    if model.fidelity == 0:
        return OUTPUT[model.friction_law]
    each = SEARCH_PERIOD[model.friction_law] + period_cost(model, tolerance, scales)
    return SEARCH + periods * each
