"""What leaps over periods cost against resolved motion of the same accuracy; `-rP` prints it.

CPU times of what an FMU does in a run: it initializes, steps, and gives the mean velocity of each.
Both are run in turn, and the ratio is the median of these pairs, so that a busy machine slows both
down.
"""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from math import tau
from statistics import median

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.fmu.instance import Instance

PAIRS = 5
PERIOD = tau / 3500.0
LEAPING = {"fidelity": 0.0, "averaging_order": 2.0}
FAST = {"drive_frequency": 35e3, "resonator_frequency": 35e3, "base_amplitude": 1e-5}


@dataclass(frozen=True)
class Gain:
    """A device, the loosest tolerances of leaps and of bristles that leave an error of the mean
    velocity of at most `max_error` of its peak, and the least ratio of costs.

    A run has `count` steps of `size` (s).
    """

    device: Mapping[str, float]
    leaps: float
    least: float
    bristles: float = 1e-8
    max_error: float = 1e-6
    size: float = 2.0
    count: int = 10


def on_bristles(stiffness: float, leaps: float, bristles: float) -> Gain:
    return Gain({"friction_law": 1, "bristle_stiffness": stiffness}, leaps, 4.0, bristles)


GAINS = {
    "3500 rad/s": Gain({}, 1e-6, 5.0),
    "35 000 rad/s": Gain(FAST, 1e-6, 30.0),
    "steps of 1000 periods": Gain({}, 1e-5, 8.0, size=1000.0 * PERIOD, count=60, max_error=3e-5),
    "LuGre, 1e4": on_bristles(1e4, 1e-7, 3e-8),
    "LuGre, 1e5": on_bristles(1e5, 3e-7, 3e-7),
    "LuGre, 1e7": on_bristles(1e7, 3e-7, 3e-5),
}


def mean_velocities(
    instance: Instance, values: Mapping[str, float], size: float, count: int
) -> tuple[Array, float]:
    """Return the mean velocity (m/s) after each step and the CPU time (s).

    The instance is new: an old one may keep tables.
    """
    instance.recreate()
    instance.set_up()
    instance.set(values)
    read = instance.block(("mean_velocity",)).read
    found = []
    began = time.process_time()
    instance.call("fmi2EnterInitializationMode")
    instance.begin()
    for _ in range(count):
        instance.step_by(size)
        found += read()
    return np.array(found), time.process_time() - began


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=pytest.mark.slow if n.startswith("LuGre") else ()) for n in GAINS],
)
@pytest.mark.parametrize("longer", [1, pytest.param(5, marks=pytest.mark.nightly)])
def test_leaps_cost_far_less(instance: Instance, name: str, longer: int) -> None:
    gain = GAINS[name]
    count = longer * gain.count
    finest = {**gain.device, "fidelity": 2.0, "tolerance": 1e-13}
    exact, _ = mean_velocities(instance, finest, gain.size, count)
    leaping = {**gain.device, **LEAPING, "tolerance": gain.leaps}
    resolved = {**finest, "tolerance": gain.bristles}
    ratios = []
    for _ in range(PAIRS):
        costs = []
        for values in (leaping, resolved):
            means, seconds = mean_velocities(instance, values, gain.size, count)
            assert np.abs(means - exact).max() <= gain.max_error * np.abs(exact).max()
            costs.append(seconds)
        ratios.append(costs[1] / costs[0])
    print(f"{name}, {count * gain.size:.3g} s: {median(ratios):.3g} times cheaper")
    assert median(ratios) > gain.least
