"""The cost of a run, from counts alone, so that the same scene always has the same answer.

The counts are communication steps, drive periods, and for averaged motion beats and relaxation
times; their weights were fitted to the CPU time of the native FMU behind fmpy. A model of cost
decides between candidates; the seconds of another machine are another multiple of it.
"""

from __future__ import annotations

from math import log10

from slider_resonator.studies.choose.candidate import LUGRE, Candidate, Model
from slider_resonator.studies.choose.scales import Scales

RUN = 40e-6
"""Seconds of a run besides its start and its steps."""
START = 10e-6
"""Seconds to initialise the FMU."""
STEP = 3.1e-6
"""Seconds for a communication step through fmpy, with four outputs read."""
COULOMB_PERIOD = {1: 0.5e-6, 2: 0.6e-6}
"""Seconds of a drive period by fidelity: two reversals, each between closed forms."""
LUGRE_PERIOD = {1: 0.8, 2: 1.0}
"""Cost of LuGre friction by fidelity, relative to the full device."""
LUGRE_FIXED, LUGRE_PER_DIGIT = 1.3e-6, 0.55e-6
"""Seconds of a drive period: those for any tolerance and those for each digit of it."""
BRISTLE_TURN = 3.5e-6
"""Seconds of an oscillation on the bristle, where the slider sticks."""
SLOW_START = 40e-6
"""Seconds of averaged motion for its first transient, whatever its length."""
SLOW_RELAXATION = 0.7e-6
"""Seconds for each relaxation time: an explicit method is bounded by it."""
SLOW_BEAT = 6e-6
"""Seconds for each beat that the slow motion follows."""
BRISTLE_TABLE = 1.2e-3
"""Seconds to tabulate the mean friction of a bristle, once per device."""
LIFTED_BRISTLE = {"step": 60e-6, "start": 0.7e-3, "beat": 2.2e-3}
"""Seconds for the same where the contact lifts: then nothing is tabulated."""


def period_cost(model: Model, tolerance: float, scales: Scales) -> float:
    """Return the cost (s) of a drive period at fidelity 1 or 2."""
    if model.friction_law == LUGRE:
        digits = -log10(tolerance)
        sliding = LUGRE_PERIOD[model.fidelity] * (LUGRE_FIXED + LUGRE_PER_DIGIT * digits)
        return sliding + BRISTLE_TURN * scales.bristle_turns
    return COULOMB_PERIOD[model.fidelity]


def run_cost(candidate: Candidate, scales: Scales, duration: float, steps: int) -> float:
    """Return the cost (s) of a run of `duration` (s) in that number of steps."""
    cost = RUN + START + STEP * steps
    model = candidate.model
    if model.fidelity > 0:
        return cost + duration / scales.period * period_cost(model, candidate.tolerance, scales)
    beats = scales.beat * duration
    if model.friction_law == LUGRE and scales.lifts:
        weight = LIFTED_BRISTLE
        return cost + weight["start"] + weight["step"] * steps + weight["beat"] * beats
    cost += SLOW_START + SLOW_BEAT * beats + SLOW_RELAXATION * duration / scales.relaxation
    return cost + (BRISTLE_TABLE if model.friction_law == LUGRE else 0.0)


def search_cost(model: Model, tolerance: float, periods: int, scales: Scales) -> float:
    """Return the cost (s) of a search by shooting over that number of drive periods in total.

    At fidelity 0 it is one initialisation: the outputs are the averaged theory.
    """
    table = BRISTLE_TABLE if model.friction_law == LUGRE else 0.0
    if model.fidelity == 0:
        return START + table
    return periods * (START + STEP + period_cost(model, tolerance, scales))
