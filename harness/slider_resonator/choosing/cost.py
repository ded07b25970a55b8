"""The cost of a run, from counts alone, so that the same scene always has the same answer.

The counts are communication steps, changes of the inputs, drive periods, and for averaged motion
beats and relaxation times, with leaps the drive periods that are mapped. Their weights were fitted
to runs of the native FMU in a host in C: the shortest of several CPU times, each in a new
instance. Steps and changes are those of fmpy (`python -m tests.harness.choosing.pricing`
compares with it). A model of cost decides between candidates; the seconds of another machine are
another multiple of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log10

from slider_resonator.choosing.candidate import COULOMB, LUGRE, Candidate, Model
from slider_resonator.choosing.leap_work import LEAP_TOLERANCE, resolved_periods
from slider_resonator.choosing.plan import Plan
from slider_resonator.choosing.resolved_cost import FORGETS, period_cost, resolved_cost
from slider_resonator.choosing.scales import Scales

RUN = 40e-6
"""Seconds of a run besides its steps: the start of the FMU, the record, one state."""
STEP = 2.6e-6
"""Seconds for a communication step through fmpy, with some outputs read."""
CHANGE = 1.8e-6
"""Seconds to set inputs that have changed."""


@dataclass(frozen=True)
class AveragedPrices:
    """Seconds of averaged motion.

    `start` is for the start, `table` for the mean friction of a bristle, at the start and after
    each change of a parameter. `step` is added to each communication step, and `MOVING` times as
    much to one that is long against the relaxation time; `transient` is for each relaxation time
    after a change, until the motion has settled, and `beat` for each turn of the slow phase,
    `swing` for one in which the slow velocity follows it.
    """

    start: float
    table: float
    step: float
    transient: float
    beat: float
    swing: float


AVERAGED = {
    (COULOMB, False): AveragedPrices(10e-6, 0.0, 0.73e-6, 9.5e-6, 9e-6, 10e-6),
    (COULOMB, True): AveragedPrices(10e-6, 0.0, 0.73e-6, 9.5e-6, 9e-6, 10e-6),
    (LUGRE, False): AveragedPrices(10e-6, 0.63e-3, 0.56e-6, 4e-6, 10e-6, 20e-6),
    (LUGRE, True): AveragedPrices(10e-6, 3.3e-3, 60e-6, 0.5e-3, 2.2e-3, 0.0),
}
"""Of first order, by friction law and whether the contact lifts: then the mean friction of a
bristle is integrated."""
FOLLOWED = 8.0
"""Relaxation times in a turn of the slow phase that count fully; further ones by the power 2/3."""
MOVING = {COULOMB: 3.4, LUGRE: 7.0}
BENDING, MAX_BENDING = 0.59e-3, 2.2
"""Seconds of a table for each decade of kappa from a third on, for so many."""


AVERAGING_ORDERS = (1, 2)
"""Orders of averaged motion to choose from."""
OUTPUT = {
    (COULOMB, 1): 18e-6,
    (LUGRE, 1): 70e-6,
    (COULOMB, 2): 43e-6,
    (LUGRE, 2): 0.21e-3,
}
"""By friction law and averaging order, seconds to start the FMU and read the steady velocity or the
blocking force of the theory."""
SEARCH = 60e-6
"""Seconds of a search by shooting besides its drive periods."""
SEARCH_PERIOD = {COULOMB: 22e-6, LUGRE: 47e-6}
"""Seconds to start, read and evaluate a drive period of a search; a bristle takes more readings."""


def run_cost(candidate: Candidate, scales: Scales, plan: Plan) -> float:
    """Return the cost (s) of a run."""
    cost = RUN + STEP * plan.steps + CHANGE * plan.settings
    model, tolerance = candidate.model, candidate.tolerance
    periods = plan.duration / scales.period
    if model.averaging_order == 2:
        leapt = resolved_periods(plan, scales, model.friction_law, tolerance)
        if leapt < periods:
            periods, tolerance = leapt, min(tolerance, LEAP_TOLERANCE)
        model = Model(2, model.friction_law)
    if model.fidelity == 0:
        return cost + _averaged_cost(model, scales, plan)
    return cost + resolved_cost(model, tolerance, scales, plan, periods)


def _averaged_cost(model: Model, scales: Scales, plan: Plan) -> float:
    prices = AVERAGED[model.friction_law, scales.lifts]
    table = prices.table
    if model.friction_law == LUGRE and scales.kappa:
        table += BENDING * min(max(log10(scales.kappa) + 0.5, 0.0), MAX_BENDING)
    starts, relaxations = 1 + plan.kicks, plan.duration / scales.relaxation
    moving = min(1.0, relaxations / plan.steps)
    cost = prices.start + table * (1 + plan.tunings)
    cost += prices.step * plan.steps * (1.0 + MOVING[model.friction_law] * moving)
    cost += plan.beats * (prices.beat + prices.swing * _swing(scales, plan))
    return cost + prices.transient * starts * min(relaxations / starts, FORGETS)


def _swing(scales: Scales, plan: Plan) -> float:
    """Return the work of following the slow velocity in a turn of the slow phase."""
    if plan.beats == 0.0:
        return 0.0
    relaxations = plan.duration / scales.relaxation / plan.beats
    further = max(1.0, relaxations / FOLLOWED)
    return min(relaxations, FOLLOWED) * float(further ** (2.0 / 3.0))


def search_cost(model: Model, tolerance: float, periods: int, scales: Scales) -> float:
    """Return the cost (s) of a search by shooting over that number of drive periods in total.

    At fidelity 0 it is one initialisation: the outputs are the averaged theory.
    """
    if model.fidelity == 0:
        return OUTPUT[model.friction_law, model.averaging_order or 1]
    each = SEARCH_PERIOD[model.friction_law] + period_cost(model, tolerance, scales)
    return SEARCH + periods * each
