"""The cost of a run, from counts alone, so that the same scene always has the same answer.

The counts are communication steps, changes of the inputs, drive periods, and for averaged motion
beats, relaxation times, and the orbits that are prepared and followed. Their weights were fitted to
some 1400 runs of the native FMU in a host in C: the shortest of several CPU times, each in a new
instance. Steps and changes are those of fmpy (`python -m tests.harness.studies.choose.pricing`
compares with it). A model of cost decides between candidates; the seconds of another machine are
another multiple of it.
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


@dataclass(frozen=True)
class OrbitPrices:
    """Seconds of averages of second order.

    `start` is once. `curve` is for each curve of orbits and `panel` for each part of one that is
    visited, in table 1; it grows with the share of friction in the drive to the power `rough`, and
    is `lifting` times as much where the contact lifts. `edge` is added where the slider
    ceases to turn back, `shifts` for a curve on which inputs jump. `step` is for a
    communication step, `mark` for an end of a period in it, of which the last two count, `moving`
    is added while the slow velocity settles, `load` for a change of the load, and `drifting` while
    the lead drifts. `searched` is for step and marks where orbits are searched, `change` for going
    over to another lead, `combined` for making a curve at one from the series. `beat` and `swing`
    are for a turn of the slow phase as with averages of first order, `swing` times the root of the
    share of friction in the drive; `searched_beat` and `searched_swing` are for one that searches,
    `searched_transient` for a relaxation time that does.

    What maps drive periods costs as many times more as a map of the bristle does.
    """

    start: float
    curve: float
    panel: float
    rough: float
    lifting: float
    edge: float
    shifts: float
    step: float
    mark: float
    moving: float
    load: float
    drifting: float
    searched: float
    change: float
    combined: float
    beat: float
    swing: float
    searched_beat: float
    searched_swing: float
    searched_transient: float


ORBITS = {
    COULOMB: OrbitPrices(
        start=10e-6,
        curve=20e-6,
        panel=0.1e-3,
        rough=0.44,
        lifting=2.7,
        edge=1.7e-3,
        shifts=0.2e-3,
        step=0.27e-6,
        mark=1.05e-6,
        moving=1.85e-6,
        load=1.8e-6,
        drifting=9.7e-6,
        searched=20e-6,
        change=6e-6,
        combined=0.2e-3,
        beat=60e-6,
        swing=1.2e-3,
        searched_beat=0.27e-3,
        searched_swing=0.76e-3,
        searched_transient=3e-3,
    ),
    LUGRE: OrbitPrices(
        start=5e-6,
        curve=20e-6,
        panel=0.5e-3,
        rough=0.1,
        lifting=1.2,
        edge=1.3e-3,
        shifts=0.35e-3,
        step=1.6e-6,
        mark=1.9e-6,
        moving=2.2e-6,
        load=86e-6,
        drifting=10e-6,
        searched=0.2e-3,
        change=60e-6,
        combined=0.32e-3,
        beat=90e-6,
        swing=1.65e-3,
        searched_beat=6e-3,
        searched_swing=5e-3,
        searched_transient=4e-3,
    ),
}
"""By friction law."""
SLOW_BRISTLE = 0.2
"""Share of friction in the drive, over kappa, beyond which a bristle is as slow as the slow motion:
no orbits are found, and all motion is resolved."""
EDGE, REACHED = 0.9, 0.4
"""Slow over fast velocity beyond which the slider hardly turns back, and what such a part costs
over one that is passed."""
EDGE_ROUGH = 0.15
"""Power of the share of friction in the drive by which that part costs more."""
PANELS = (-inf, -0.7, 0.0, 0.7, inf)
"""Slow over fast velocities between which panels lie."""
NEXT = 0.03
"""Overlap with a panel that is not followed."""
USUAL = (0.1, 0.6)
"""Slow over fast velocity, where it is not known."""
MIN_SLOWNESS, SLOWNESS_OF_TABLE_1 = 1e-5, 2.2e-4
"""Share of friction in the drive below which panels cost no less, and that of table 1."""
SETTLES = 12.0
"""Relaxation times in which the slow velocity settles so far that it counts as constant."""
LOAD_PERIODS = 5.0
"""Drive periods in which a change of the load is worked off."""
ORBIT_SHARE = 0.01
"""Tolerance of a map of orbits of LuGre friction, over that of the run."""
MAP, USUAL_MAP = 1.4e-6, 4e-6
"""Seconds of a map of orbits of LuGre friction besides the motion in it, and of one at the prices
above."""
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
    maps = _map_cost(full, candidate.tolerance, scales)
    cost += prices.start + maps * work.curves * _curve_cost(prices, scales, slow)
    if plan.kicks:
        cost += maps * prices.shifts * work.curves
    cost += prices.change * work.changes + maps * prices.combined * work.combined
    length = plan.duration / plan.steps / scales.period
    steps, marks = plan.steps / periods, min(2.0, length)
    settling = SETTLES * (1 + plan.kicks) * scales.relaxation / plan.duration
    each = prices.step + marks * prices.mark + min(1.0, settling) * prices.moving
    cost += steps * work.tabulated * each
    cost += steps * work.drifting * prices.drifting
    loads = max(0, plan.kicks - sum(stay.count for stay in plan.stays[1:]))
    cost += prices.load * loads * min(1.0, length / LOAD_PERIODS)
    cost += maps * steps * work.searched * (1.0 + marks) * prices.searched
    swing = _swing(scales, plan)
    each = prices.beat + prices.swing * sqrt(scales.slowness or 0.0) * swing
    cost += each * work.tabulated_beats
    each = prices.searched_beat + prices.searched_swing * swing
    cost += maps * each * work.searched_beats
    if work.searched_beats == 0.0:
        relaxations = work.searched * scales.period / scales.relaxation
        cost += maps * prices.searched_transient * min(relaxations, FORGETS * (1 + plan.kicks))
    return cost


def _map_cost(model: Model, tolerance: float, scales: Scales) -> float:
    """Return the cost of mapping a drive period for orbits, relative to a usual one."""
    if model.friction_law == COULOMB:
        return 1.0
    return (MAP + period_cost(model, ORBIT_SHARE * tolerance, scales)) / USUAL_MAP


def _curve_cost(prices: OrbitPrices, scales: Scales, slow: tuple[float, float]) -> float:
    """Return the cost (s) of the curve of orbits at a lead."""
    low, high = slow
    if low > 1.0 or high < -1.0:
        return prices.curve
    visited = [low < right - NEXT and high > left + NEXT for left, right in pairwise(PANELS)]
    share = max(scales.slowness or 0.0, MIN_SLOWNESS) / SLOWNESS_OF_TABLE_1
    cost = prices.panel * max(1, sum(visited)) * float(share**prices.rough)
    if scales.lifts:
        cost *= prices.lifting
    passed = (low < -1.0) + (high > 1.0)
    reached = (low < -EDGE) + (high > EDGE) - passed
    edges = (passed + REACHED * reached) * float(share**EDGE_ROUGH)
    return prices.curve + cost + prices.edge * edges


def search_cost(model: Model, tolerance: float, periods: int, scales: Scales) -> float:
    """Return the cost (s) of a search by shooting over that number of drive periods in total.

    At fidelity 0 it is one initialisation: the outputs are the averaged theory.
    """
    if model.fidelity == 0:
        return OUTPUT[model.friction_law, model.averaging_order or 1]
    each = SEARCH_PERIOD[model.friction_law] + period_cost(model, tolerance, scales)
    return SEARCH + periods * each
