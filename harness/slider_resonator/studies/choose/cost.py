"""The cost of a run, from counts alone, so that the same scene always has the same answer.

The counts are communication steps, changes of the inputs, drive periods, and for averaged motion
beats, relaxation times, and the orbits that are prepared and followed. Their weights were fitted to
some 650 runs of the native FMU in a host in C: the shortest of several CPU times, in units of the
instructions of a resolved run of table 1, at 0.095 ns each. Steps and changes are those of fmpy
(`python -m tests.harness.studies.choose.pricing` compares with it). A model of cost decides between
candidates; the seconds of another machine are another multiple of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import inf, log10, sqrt

from slider_resonator.studies.choose.candidate import COULOMB, LUGRE, Candidate, Model
from slider_resonator.studies.choose.orbit_work import orbit_work
from slider_resonator.studies.choose.plan import Plan
from slider_resonator.studies.choose.resolved_cost import FORGETS, period_cost, resolved_cost
from slider_resonator.studies.choose.scales import Scales

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
    (COULOMB, False): AveragedPrices(10e-6, 0.0, 0.4e-6, 3e-6, 9e-6, 9e-6),
    (COULOMB, True): AveragedPrices(10e-6, 0.0, 0.4e-6, 3e-6, 9e-6, 9e-6),
    (LUGRE, False): AveragedPrices(10e-6, 0.4e-3, 1.7e-6, 3e-6, 10e-6, 9e-6),
    (LUGRE, True): AveragedPrices(10e-6, 2e-3, 60e-6, 0.5e-3, 2.2e-3, 0.0),
}
"""Of first order, by friction law and whether the contact lifts: then the mean friction of a
bristle is integrated."""
FOLLOWED = 8.0
"""Relaxation times in a turn of the slow phase that count fully; further ones by the power 2/3."""
MOVING = {COULOMB: 4.0, LUGRE: 0.5}
BENDING, MAX_BENDING = 0.45e-3, 2.2
"""Seconds of a table for each decade of kappa from a third on, for so many."""


@dataclass(frozen=True)
class OrbitPrices:
    """Seconds of averages of second order.

    `panel` is for a part of a curve of orbits, `lifting` times as much where the contact lifts;
    `edge` is added for one in which the slider hardly turns back, and `curve` for each curve.
    `step` is for a communication step, `mark` for an end of a period in it, of which the last two
    count; `drifting` is added to a step in which the lead drifts, `searched` is for step and marks
    where orbits are searched, `change` for going over to another lead, `combined` for making a
    curve at one from the series. `beat` and `swing` are for a turn of the slow phase as with
    averages of first order, `swing` times the root of the share of friction in the drive;
    `searched_beat` and `searched_swing` are for one that searches, `searched_transient` for a
    relaxation time that does. Steps that search among soft bristles cost `soft_search` times as
    much. `start` is once, `load` for each change of the load.
    """

    curve: float
    panel: float
    lifting: float
    edge: float
    step: float
    mark: float
    drifting: float
    searched: float
    change: float
    combined: float
    beat: float
    swing: float
    searched_beat: float
    searched_swing: float
    searched_transient: float
    start: float = 20e-6
    load: float = 0.0
    soft_search: float = 1.0


ORBITS = {
    COULOMB: OrbitPrices(
        curve=0.0,
        panel=0.2e-3,
        lifting=1.8,
        edge=1.7e-3,
        step=1.25e-6,
        mark=0.4e-6,
        drifting=9e-6,
        searched=16e-6,
        change=6e-6,
        combined=0.55e-3,
        beat=50e-6,
        swing=1.5e-3,
        searched_beat=0.2e-3,
        searched_swing=0.5e-3,
        searched_transient=0.25e-3,
    ),
    LUGRE: OrbitPrices(
        curve=0.3e-3,
        panel=0.5e-3,
        lifting=2.2,
        edge=1.4e-3,
        step=1.5e-6,
        mark=2e-6,
        drifting=10e-6,
        searched=0.11e-3,
        change=60e-6,
        combined=0.32e-3,
        beat=90e-6,
        swing=5e-3,
        searched_beat=2.5e-3,
        searched_swing=3e-3,
        searched_transient=1.5e-3,
        load=50e-6,
        soft_search=0.03,
    ),
}
"""By friction law."""
SOFT_BRISTLE = 3.0
"""Path of the vibration over that of the bristle below which it counts as soft."""
SLOW_BRISTLE = 0.2
"""Share of friction in the drive, over kappa, beyond which a bristle is as slow as the slow motion:
no orbits are found, and all motion is resolved."""
EDGE = 0.9
"""Slow over fast velocity beyond which the slider hardly turns back."""
PANELS = (-inf, -0.7, 0.0, 0.7, inf)
"""Slow over fast velocities between which panels lie."""
NEXT = 0.03
"""Overlap with a panel that is not followed."""
USUAL = (0.1, 0.6)
"""Slow over fast velocity, where it is not known."""
ROUGH = 2.0
"""Root of the share of friction in the drive by which orbits cost more, up to twice as much."""
LOAD_PERIODS = 5.0
"""Drive periods in which a change of the load is worked off."""
ORBIT_DIGIT, ORBIT_DIGITS = 0.06, 8.0
"""Share of a curve that each digit less of the tolerance saves, below so many."""
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


def run_cost(
    candidate: Candidate, scales: Scales, plan: Plan, slow: tuple[float, float] = USUAL
) -> float:
    """Return the cost (s) of a run.

    `slow` are the least and the greatest slow velocity in it, in fast velocities.
    """
    cost = RUN + STEP * plan.steps + CHANGE * plan.settings
    model = candidate.model
    if model.fidelity == 0:
        if model.averaging_order == 2 and scales.has_orbits:
            return cost + _orbit_cost(candidate, scales, plan, slow)
        return cost + _averaged_cost(model, scales, plan)
    periods = plan.duration / scales.period
    return cost + resolved_cost(model, candidate.tolerance, scales, plan, periods)


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


def _orbit_cost(
    candidate: Candidate, scales: Scales, plan: Plan, slow: tuple[float, float]
) -> float:
    law = candidate.model.friction_law
    prices, full = ORBITS[law], Model(2, law)
    periods = plan.duration / scales.period
    if law == LUGRE and (scales.slowness or 0.0) > SLOW_BRISTLE * (scales.kappa or inf):
        return resolved_cost(full, candidate.tolerance, scales, plan, periods)
    work = orbit_work(plan, scales, law)
    cost = resolved_cost(full, candidate.tolerance, scales, plan, work.resolved)
    rough = 1.0 + min(1.0, ROUGH * sqrt(scales.slowness or 0.0))
    coarse = ORBIT_DIGIT * max(0.0, ORBIT_DIGITS + log10(candidate.tolerance))
    cost += prices.start + work.curves * (1.0 - coarse) * _curve_cost(prices, scales, slow)
    cost += prices.change * work.changes + prices.combined * work.combined
    length = plan.duration / plan.steps / scales.period
    steps, marks = rough * plan.steps / periods, min(2.0, length)
    cost += steps * work.tabulated * (prices.step + marks * prices.mark)
    cost += steps * work.drifting * prices.drifting
    loads = max(0, plan.kicks - sum(stay.count for stay in plan.stays[1:]))
    cost += prices.load * loads * min(1.0, length / LOAD_PERIODS)
    search = prices.soft_search if _is_soft(scales) else 1.0
    cost += search * steps * work.searched * (1.0 + marks) * prices.searched
    swing = _swing(scales, plan)
    each = prices.beat + prices.swing * sqrt(scales.slowness or 0.0) * swing
    cost += each * work.tabulated_beats
    each = prices.searched_beat + prices.searched_swing * swing
    cost += each * work.searched_beats
    if work.searched_beats == 0.0:
        relaxations = work.searched * scales.period / scales.relaxation
        cost += prices.searched_transient * min(relaxations, FORGETS * (1 + plan.kicks))
    return cost


def _is_soft(scales: Scales) -> bool:
    return (scales.kappa or inf) < SOFT_BRISTLE


def _curve_cost(prices: OrbitPrices, scales: Scales, slow: tuple[float, float]) -> float:
    """Return the cost (s) of the curve of orbits at a lead."""
    low, high = slow
    if low > 1.0 or high < -1.0:
        return prices.curve
    visited = [low < right - NEXT and high > left + NEXT for left, right in pairwise(PANELS)]
    cost = prices.panel * max(1, sum(visited))
    if scales.lifts:
        cost *= prices.lifting
    edges = (low < -EDGE and high > -1.0) + (high > EDGE and low < 1.0)
    return prices.curve + cost + prices.edge * edges


def search_cost(model: Model, tolerance: float, periods: int, scales: Scales) -> float:
    """Return the cost (s) of a search by shooting over that number of drive periods in total.

    At fidelity 0 it is one initialisation: the outputs are the averaged theory.
    """
    if model.fidelity == 0:
        return OUTPUT[model.friction_law, model.averaging_order or 1]
    each = SEARCH_PERIOD[model.friction_law] + period_cost(model, tolerance, scales)
    return SEARCH + periods * each
