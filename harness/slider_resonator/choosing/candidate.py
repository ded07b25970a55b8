"""The candidates: a model with its tolerance and communication step, and the search among steps."""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from math import ceil, floor, inf, isfinite, log2

from slider_resonator.choosing.errors import beat_frequency
from slider_resonator.device import schedule
from slider_resonator.device.model import LUGRE, Model
from slider_resonator.scenes.scene import Scene

TOLERANCES = tuple(10.0**-digits for digits in range(3, 13))
"""Tolerances of LuGre friction and of leaps, from the cheapest on."""
START_TOLERANCE = 1e-8
"""The FMU's start value, answered where the model has no use for a tolerance."""
MAX_PERIODS = 10_000.0
"""Drive periods in a step of resolved motion: FMUs bound the work of a step."""


def uses_tolerance(model: Model) -> bool:
    """Whether a model integrates a bristle or leaps over periods; else its accuracy is its own."""
    return model.leaps or (model.friction_law == LUGRE and model.fidelity > 0)


def tolerances(model: Model) -> tuple[float, ...]:
    """Return the tolerances to choose from, descending."""
    return TOLERANCES if uses_tolerance(model) else (START_TOLERANCE,)


@dataclass(frozen=True)
class Candidate:
    """A model with the tolerance (1) and communication step (s) it is run with.

    `step` is None where nothing is run.
    """

    model: Model
    tolerance: float
    step: float | None

    @property
    def parameters(self) -> dict[str, float]:
        """The FMU parameters that make it."""
        return {**self.model.parameters, "tolerance": self.tolerance}


SIGNAL_NEEDS = frozenset({"position", "velocity", "mean_velocity_throughout", "event_times"})
"""Needs that are judged at every step of the scene, not at its end only."""
FINEST = 64
"""Maximum steps in a drive period."""


def step_ladder(
    scene: Scene, needs: Collection[str], max_steps: int, *, varying: bool
) -> tuple[float, ...]:
    """Return the steps (s) to choose from, descending.

    Signals are needed at every step of the scene, which is then the longest; a beat needs some
    steps each, and how many is tried; a number at the end needs one step, or as many as the FMU
    takes. Where something `varying` is held, or a beat is read, steps are the scene's own times
    powers of two, and at most `max_steps`. Input jumps are communication points in any case.
    """
    duration = scene.stop_time or 0.0
    own = scene.step_size or duration
    allowed = MAX_PERIODS * scene.drive_period
    if SIGNAL_NEEDS & set(needs):
        longest = min(duration, own)
    elif varying or "beat" in needs:
        longest = min(duration, allowed)
    else:
        own = longest = duration
    shortest = min(longest, allowed)
    if "beat" in needs:  # 4 to 8 steps show one, 64 to 128 points of a run give its frequency
        frequency = beat_frequency(scene)
        beat = 1.0 / frequency if frequency else inf
        shortest = min(shortest, duration / 128, beat / 8.0)
        longest = min(longest, duration / 64, beat / 4.0)
    first = own * 2.0 ** floor(log2(longest / own * (1.0 + 1e-9)))
    halvings = ceil(log2(first / shortest))
    if varying:
        finest = (scene.drive_period / FINEST, duration / schedule.MAX_STEPS, duration / max_steps)
        halvings = floor(log2(first / min(first, max(finest))))
    return tuple(first * 2.0**-index for index in range(halvings + 1))


STALLED = 0.7
"""A refinement that leaves more than this share of the error does not converge."""
PATIENCE = 2
"""Refinements in turn that must stall: coarse ones can be outside the range of convergence."""


def coarsest(excess: Callable[[int], float], count: int, fine: int = 0) -> int | None:
    """Return the smallest index below `count` with `excess(index)` <= 1, None where none has.

    `excess` is error over allowed error. Gives up where the error does not fall, but not above
    index `fine`: coarser ones may miss what happens.
    """
    stalled, before = 0, inf
    for index in range(count):
        found = excess(index)
        if found <= 1.0:
            return index
        stalled = stalled + 1 if isfinite(found) and found > STALLED * before else 0
        if stalled >= PATIENCE and index >= fine:
            return None
        before = found
    return None
