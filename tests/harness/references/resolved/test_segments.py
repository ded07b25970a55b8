"""What a resolved trajectory is made of: contact modes, their sequence and located roots."""

import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import is_lifted, time_to_contact_change
from slider_resonator.references.resolved.mode_sequence import ModeSequence, Segment, SegmentResult
from slider_resonator.references.resolved.polynomial_roots import first_fall


@pytest.mark.parametrize("rate", [3500.0, -3500.0, 0.5])
@pytest.mark.parametrize("amplitude", [1.0 + 1e-9, 1.5, 40.0])
@pytest.mark.parametrize("angle", [-3.0, 0.0, 1.0, 3.5, 5.0, 100.0])
def test_contact_changes_at_zero_normal_load(rate: float, amplitude: float, angle: float) -> None:
    for lifted in (False, True):
        time = time_to_contact_change(lifted, 1.0, amplitude, angle, rate)
        assert 0.0 <= time <= 2.0 * math.pi / abs(rate), "it happens once in every period"
        load = 1.0 + amplitude * math.sin(angle + rate * time)
        assert load == pytest.approx(0.0, abs=1e-12 * amplitude), "there the load vanishes"
        slope = amplitude * rate * math.cos(angle + rate * time)
        assert (slope < 0.0) == (not lifted), "lift-off where it falls, touchdown where it rises"


@pytest.mark.parametrize("rate", [1.0, -1.0])
def test_contact_at_a_crossing_is_the_one_just_after(rate: float) -> None:
    assert is_lifted(0.0, 1.0, math.pi, 1.0), "at lift-off it has lifted"
    assert not is_lifted(0.0, 1.0, 2.0 * math.pi, 1.0), "at touchdown it has touched down"
    assert time_to_contact_change(False, 1.0, 1.0, -math.pi / 2.0, rate) == math.inf
    assert not is_lifted(1.0, 1.0, -math.pi / 2.0, rate), "touching is not lifting"


def test_constant_normal_load_never_changes_the_contact() -> None:
    assert time_to_contact_change(False, 1.0, 2.0, 0.0, 0.0) == math.inf
    assert time_to_contact_change(True, 1.0, 2.0, -1.5, 0.0) == math.inf
    assert is_lifted(1.0, 2.0, -1.5, 0.0), "1 + 2 sin(-1.5) < 0: open for good"
    assert not is_lifted(1.0, 2.0, 0.0, 0.0)
    assert is_lifted(0.0, 0.0, 0.3, 1.0), "without any normal load there is no contact"


NOISE = 1e-15


def fall(polynomial: Polynomial, stop: float = 1.0) -> float | None:
    terms = polynomial.coef.astype(np.float64) * stop ** np.arange(len(polynomial.coef))
    share = first_fall(terms, NOISE)
    return None if share is None else share * stop


RISES = Polynomial([1.0, -2.0])


@pytest.mark.parametrize(
    ("polynomial", "stop", "expected"),
    [
        (-Polynomial.fromroots([0.3, 0.5, 0.7]), 1.0, 0.3),
        (Polynomial.fromroots([-0.1, 0.3, 0.7]), 1.0, 0.3),
        (Polynomial.fromroots([0.37, 0.37]) + 1e-9, 1.0, None),
        (Polynomial([0.0, 0.0, 0.0]), 1.0, None),
        (Polynomial([1.0, -1.0]), 0.999, None),
        (Polynomial([2.0, -1.0]), 4.0, 2.0),
        # Roots at the start, of first and second order, also by rounding.
        *((Polynomial.fromroots([0.0] * n) * RISES, 1.0, 0.5) for n in (1, 2)),
        *((Polynomial.fromroots([0.0] * n) * RISES - 1e-17, 1.0, 0.5) for n in (1, 2)),
        *((-Polynomial.fromroots([0.0] * n), 1.0, 0.0) for n in (1, 2)),
    ],
    ids=str,
)
def test_first_fall_is_found(polynomial: Polynomial, stop: float, expected: float | None) -> None:
    """In the interval up to `stop`; a near miss is no root."""
    found = fall(polynomial, stop)
    assert found == (None if expected is None else pytest.approx(expected, rel=1e-14))


@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-6])
def test_twin_roots_are_not_stepped_over(gap: float) -> None:
    twins = Polynomial.fromroots([0.37, 0.37 + gap])
    assert fall(twins) == pytest.approx(0.37, abs=1e-15 / gap)


def test_random_polynomials_agree_with_a_fine_grid() -> None:
    random = np.random.default_rng(1)
    grid = np.linspace(0.0, 1.0, 20_001)
    for _ in range(200):
        coefficients = random.normal(size=23) * 2.0 ** np.arange(23)
        coefficients[0] = abs(coefficients[0])
        below = np.flatnonzero(Polynomial(coefficients)(grid) < 0.0)
        found = first_fall(coefficients, NOISE * 2.0**23)
        if below.size:
            assert found is not None
            assert grid[below[0] - 1] - 1e-9 <= found <= grid[below[0]], "the first on the grid"
        elif found is not None:
            assert Polynomial(coefficients)(found) == pytest.approx(0.0, abs=1e-6)


BLOCK = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)


def test_unresolvable_contact_is_an_error_with_its_time() -> None:
    def stuttering(segment: Segment) -> SegmentResult:
        return SegmentResult(0.0, segment.state, 1, np.empty((0, 4)), steps=1, evaluations=1)

    with pytest.raises(RuntimeError, match=r"contact at t = 0\.25 s"):
        ModeSequence(BLOCK, stuttering, np.empty(0)).run([HeldInputs(0.25, 1.0)])
