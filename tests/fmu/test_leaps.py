"""Fidelity 0, order 2: motion that leaps over periods, against resolved motion of the same FMU."""

import math
import random
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.fmu.host import OUTPUTS, Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

PERIOD = math.tau / 3500.0
FAST = 0.2366097
"""v_q of table 1, m/s."""
EXACT = 1e-11
"""Tolerance of bristles that are resolved for comparison."""


def compared(
    instantiate: Instantiate, values: Mapping[str, float], size: float, steps: int
) -> NDArray[np.float64]:
    """Rows of errors of the mean velocity [m/s] and position [m] against resolved motion, and of
    the estimate [m/s], at the ends of steps of a size in s."""
    leaping = instantiate().initialize(**{**values, "fidelity": 0})
    tolerance = {"tolerance": EXACT} if values.get("friction_law") else {}
    full = instantiate().initialize(**{**values, **tolerance, "fidelity": 2})
    found = []
    for _ in range(steps):
        for instance in (leaping, full):
            instance.step(size)
        mean, position, estimate = leaping.get("mean_velocity", "position", "slow_motion_error")
        reference, place = full.get("mean_velocity", "position")
        found.append((abs(mean - reference), abs(position - place), estimate))
    return np.transpose(found)


def test_the_error_follows_the_tolerance(instantiate: Instantiate) -> None:
    for tolerance in (1e-5, 1e-6, 1e-7, 1e-8, 1e-9):
        values = {"tolerance": tolerance}
        error, travel, estimate = compared(instantiate, values, 1000.0 * PERIOD, 4).max(axis=1)
        assert error <= 3.0 * tolerance * FAST
        assert travel <= 3.0 * tolerance * FAST * 4000.0 * PERIOD
        assert estimate <= 10.0 * tolerance * FAST
    assert error <= 1e-3 * 3.0 * 1e-6 * FAST


class Case(NamedTuple):
    """A device by its parameters, with v_q [m/s] and a third of its transient [s]."""

    values: dict[str, float]
    fast: float
    step: float


def case_of(draw: random.Random, law: int, tolerance: float) -> Case:
    mass, w = 10.0 ** draw.uniform(-1.0, 0.5), 10.0 ** draw.uniform(2.5, 4.0)
    m = mass * draw.uniform(0.02, 0.3)
    wn, xi = w * 10.0 ** draw.uniform(-0.52, 0.48), 10.0 ** draw.uniform(-2.5, 0.3)
    base, preload = 10.0 ** draw.uniform(-5.0, -3.5), 10.0 ** draw.uniform(-0.5, 1.0)
    amplitude = draw.choice([draw.uniform(0.0, 1.0), draw.uniform(1.0, 1.8)])
    share, total = 10.0 ** draw.uniform(-4.0, -1.52), mass + m
    drive = m * base * w * w
    spring = m * wn * wn + 2j * xi * m * wn * w
    swing = drive * (1.0 - m / total) / (spring - m * w * w + m * m * w * w / total)
    fast = abs((drive + m * w * w * swing) / (total * w))
    friction = 0.5 * share * total * w * fast / (max(1.0, amplitude / math.pi) * preload)
    values = {
        "slider_mass": mass,
        "resonator_mass": m,
        "resonator_frequency": wn,
        "damping_ratio": xi,
        "base_amplitude": base,
        "drive_frequency": w,
        "normal_preload": preload,
        "normal_amplitude": amplitude * preload,
        "friction_coefficient": friction,
        "frequency_ratio": draw.choice([1.0, 1.0, 1.0, 2.0, 3.0, 0.5, 1.5, 1.0001]),
        "phase": draw.uniform(0.0, 6.2),
        "load": draw.choice([0.0, draw.uniform(-0.6, 0.6)]) * 2.0 * friction * preload,
        "tolerance": tolerance,
    }
    if law == 1:
        stiffness = 10.0 ** draw.uniform(1.0, 3.5) * friction * w / fast
        values |= {"friction_law": 1, "bristle_stiffness": stiffness}
        values |= {"bristle_damping": 10.0 ** draw.uniform(-3.0, -1.0) * friction / fast}
    return Case(values, fast, max(200.0, 1.0 / (3.0 * share)) * math.tau / w)


MANY = [
    pytest.param(law, tolerance, 1600, 111, marks=pytest.mark.nightly)
    for law in (0, 1)
    for tolerance in (1e-4, 1e-6, 1e-8)
]


@pytest.mark.parametrize(
    ("law", "tolerance", "count", "seed"), [(0, 1e-6, 60, 1707), (1, 1e-6, 16, 1708), *MANY]
)
def test_random_devices_keep_the_tolerance_and_know_their_error(
    instantiate: Instantiate, law: int, tolerance: float, count: int, seed: int
) -> None:
    """At most ten times what is allowed, nearly all at most three times what is estimated.

    The estimate is that of leaps: what bristles err by while they are resolved is not in it.
    """
    draw, covered, leapt = random.Random(seed), [], 0
    for _ in range(count):
        case = case_of(draw, law, tolerance)
        allowed = tolerance * case.fast
        errors, _, estimates = compared(instantiate, case.values, case.step, 4)
        assert max(errors) <= 10.0 * allowed, case.values
        leapt += estimates[-1] > 0.0
        covered += list((errors <= 3.0 * estimates)[(errors > 0.1 * allowed) & (estimates > 0.0)])
    assert leapt >= 0.6 * count
    assert sum(covered) >= 0.9 * len(covered)


@pytest.mark.parametrize(
    ("law", "tolerance", "seed", "number"),
    [
        pytest.param(1, 1e-6, 6, 93, id="a line meets the rates where it ends"),
        pytest.param(1, 1e-6, 5, 300, id="both orders of the pair agree"),
        pytest.param(0, 1e-4, 111, 551, id="both orders agree on interpolated rates"),
    ],
)
def test_errors_that_are_small_by_accident_are_noticed(
    instantiate: Instantiate, law: int, tolerance: float, seed: int, number: int
) -> None:
    """In the second step: 56, 15 and 31 tolerances where the estimate of the solver counts alone,
    or tells of a step that is too long for it."""
    draw = random.Random(seed)
    *_, case = (case_of(draw, law, tolerance) for _ in range(number + 1))
    errors, *_ = compared(instantiate, case.values, case.step, 2)
    assert max(errors) <= 3.0 * tolerance * case.fast


@pytest.mark.parametrize("tolerance", [1e-14, 1e-12])
def test_steady_motion_whose_rates_are_rounding_is_leapt_over(
    instantiate: Instantiate, tolerance: float
) -> None:
    """The next point of the slow motion may then be the same number."""
    values = {"drive_frequency": 35e3, "resonator_frequency": 35e3, "base_amplitude": 1e-5}
    instance = instantiate().initialize(**values, fidelity=0, tolerance=tolerance)
    rows = instance.run(30, 2.0)
    # The transient ends in some 16 steps, by the rounding of its last rates.
    means = [row[OUTPUTS.index("mean_velocity")] for row in rows[20:]]
    assert means == pytest.approx(means[-1:] * 10, abs=1e-11 * FAST)


@pytest.mark.parametrize("law", [0, 1])
def test_the_load_drifts_on_in_leaps_that_neglect_it(instantiate: Instantiate, law: int) -> None:
    """A drift too small to change the rates adds up over many leaps."""
    values = {"frequency_ratio": 1.0 + 1e-12, "friction_law": law, "tolerance": 1e-6}
    leaping, full = (instantiate().initialize(**values, fidelity=fidelity) for fidelity in (0, 2))
    for instance in (leaping, full):
        instance.run(5, 200.3 * PERIOD)
    assert leaping.get("normal_force") == pytest.approx(full.get("normal_force"), abs=1e-11)


@pytest.mark.parametrize("law", [0, 1])
def test_replay_is_equal_bit_by_bit(instantiate: Instantiate, law: int) -> None:
    """In the same instance, in another, and after other motion between."""
    values = {"friction_law": law, "tolerance": 1e-6, "fidelity": 0}
    one, other = instantiate().initialize(**values), instantiate().initialize(**values)
    one.step(500.0 * PERIOD)
    data, time = one.state(), one.time
    expected = one.run(3, 300.0 * PERIOD)
    for instance in (one, other):
        instance.set(load=0.1)
        instance.step(100.0 * PERIOD)
        instance.restore(data)
        instance.time = time
        assert instance.run(3, 300.0 * PERIOD) == expected
