"""Panels of bending bristles against series and known integrals: approximations to their bounds.

Scenes judge motion that is made of them, at tight tolerances and after runs of other devices.
"""

import ctypes
import math
import random

import numpy as np
import pytest
from numpy.typing import NDArray

from fmu_src.python.slider_component.variables import VARIABLES

PERIOD = math.tau / 3500.0
Array = NDArray[np.float64]


def pointer(numbers: Array) -> object:
    return numbers.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


def test_decay_is_exponential_to_rounding(native_library: ctypes.CDLL) -> None:
    x = np.concatenate(
        [np.linspace(0.0, 700.0, 70_001), np.logspace(-300, 0, 301), [1e300, np.inf]]
    )
    found = np.zeros_like(x)
    native_library.decays(pointer(x), len(x), pointer(found))
    np.testing.assert_allclose(found[:-2], np.exp(-x[:-2]), rtol=1e-14)
    assert found[-2:] == pytest.approx(math.exp(-700.0), rel=1e-12)


def test_gauss_integrals_are_exact_for_polynomials(native_library: ctypes.CDLL) -> None:
    """From 0 to each node of [0, 1], and to 1 up to the end of twice the order."""
    node, weight, integral = np.zeros(16), np.zeros(16), np.zeros((17, 16))
    native_library.gauss(pointer(node), pointer(weight), pointer(integral))
    expected, expected_weight = np.polynomial.legendre.leggauss(16)
    np.testing.assert_allclose(node, expected, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(weight, expected_weight, rtol=1e-12)
    place = 0.5 * (1.0 + node)
    for power in range(16):
        exact = np.append(place, 1.0) ** (power + 1) / (power + 1)
        np.testing.assert_allclose(integral @ place**power, exact, rtol=1e-12, atol=2e-15)
    for power in range(32):
        assert integral[-1] @ place**power == pytest.approx(1.0 / (power + 1), rel=1e-13)
    assert integral[-1] @ place**100 != pytest.approx(1.0 / 101, rel=1e-9)


def sliding_device(seed: int) -> dict[str, float]:
    """Table 1 with LuGre friction and other bristles, friction and load: slides to and fro."""
    draw = random.Random(seed)

    def decades(low: float, high: float) -> float:
        return math.exp(draw.uniform(math.log(low), math.log(high)))

    starts = {v.name: 0.0 if v.start is None else float(v.start) for v in VARIABLES}
    return starts | {
        "friction_law": 1,
        "resonator_frequency": 3500.0 * decades(0.5, 2.0),
        "damping_ratio": draw.choice([0.0, decades(1e-3, 0.3)]),
        "normal_amplitude": draw.choice([0.0, 0.5, 1.0, 1.8]),
        "base_amplitude": decades(5e-5, 1e-3),
        "friction_coefficient": decades(0.02, 2.0),
        "bristle_stiffness": decades(1e4, 1e12),
        "bristle_damping": draw.choice([0.0, decades(0.1, 100.0)]),
        "fidelity": draw.choice([1, 2]),
        "phase": draw.uniform(-3.0, 3.0),
        "frequency_ratio": draw.choice([1.0, 1.0, 1.001, 2.0, 3.0, 0.0, draw.uniform(-3.0, 3.0)]),
    }


def test_random_panels_keep_their_tolerance(native_library: ctypes.CDLL) -> None:
    """At the end, a fifth later and within, against series of tolerance 1e-14."""
    panels, errors = 0, np.zeros(4)
    for seed in range(600):
        tolerance = 0.3 * 10.0 ** -(6 + seed % 7)
        values = np.array([*sliding_device(seed).values()])
        asked = (3.3 * PERIOD, tolerance, 0.55 + 0.4 * (seed % 11) / 10)
        given = (ctypes.c_double(number) for number in asked)
        if not native_library.panel_errors(pointer(values), *given, pointer(errors)):
            continue
        panels += 1
        velocity, travel, later, within = errors  # in m/s and m
        # The series have an error, too.
        allowed = 2.0 * tolerance + 1e-13
        assert velocity <= allowed, (seed, errors, tolerance)
        assert later <= allowed, (seed, errors, tolerance)
        assert travel <= allowed * PERIOD, (seed, errors, tolerance)
        # Only means over periods that end within a panel need this: to the tolerance of the user.
        assert within <= 100.0 * allowed * PERIOD, (seed, errors, tolerance)
    assert panels > 250
