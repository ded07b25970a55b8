"""Shooting on maps whose fixed points and multipliers are known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from slider_resonator.steady.newton import Vector
from slider_resonator.steady.shooting import FixedPoint, NoFixedPoint, blocking_point, fixed_point

ONES = np.ones(2)


def linear_map(slow: float, fixed: Vector) -> tuple[np.ndarray, Vector]:
    basis = np.array([[1.0, 0.3], [-0.2, 1.0]])
    return basis @ np.diag([slow, 0.2]) @ np.linalg.inv(basis), fixed


@pytest.mark.parametrize("slow", [0.5, 1.0 - 1.0 / 1140.0, 1.0 - 1e-6, -0.9])
def test_linear_contraction_is_solved_by_one_jacobian(slow: float) -> None:
    matrix, target = linear_map(slow, np.array([0.126667, -3.0]))

    evaluations = []

    def period_map(state: Vector) -> tuple[Vector, float]:
        evaluations.append(state)
        return target + matrix @ (state - target), 2.0 * state[0]

    found = fixed_point(period_map, np.array([0.5, 1.0]), ONES)
    assert isinstance(found, FixedPoint)
    error = np.abs(found.state - target).max()
    assert error < 1e-9, f"a near-neutral direction must not cost accuracy: error {error:.1e}"
    assert found.displacement == pytest.approx(2.0 * target[0], rel=1e-8)
    assert np.abs(np.sort(found.multipliers.real) - np.sort([slow, 0.2])).max() < 1e-9
    assert found.stability == "stable"
    assert len(evaluations) <= 20, "a linear map needs one Jacobian and both neighbours"


def kinked(below: float, above: float) -> Callable[[Vector], tuple[Vector, float]]:
    """A slow direction with one multiplier below the fixed point and one above, and a fast one."""
    basis = np.array([[1.0, 0.3], [-0.2, 1.0]])

    def period_map(state: Vector) -> tuple[Vector, float]:
        slow, fast = np.linalg.solve(basis, state - 0.4)
        end = np.array([slow * (above if slow > 0.0 else below), 0.2 * fast + 0.1 * slow**2])
        return basis @ end + 0.4, 0.0

    return period_map


@pytest.mark.parametrize("sides", [(1.0, 0.99), (0.99, 1.0), (1.0, 1.0)])
def test_an_end_of_a_family_is_no_steady_motion(sides: tuple[float, float]) -> None:
    found = fixed_point(kinked(*sides), np.array([0.5, 0.3]), ONES)
    assert isinstance(found, NoFixedPoint)
    assert found.status == "not_unique"


@pytest.mark.parametrize(
    ("sides", "stability"), [((0.9, 0.99), "stable"), ((1.1, 0.8), "unstable")]
)
def test_the_weaker_side_of_a_kink_counts(sides: tuple[float, float], stability: str) -> None:
    found = fixed_point(kinked(*sides), np.array([0.5, 0.3]), ONES)
    assert isinstance(found, FixedPoint)
    assert found.multipliers[0] == pytest.approx(max(sides), rel=1e-6)
    assert found.stability == stability


def test_saturating_map_converges_from_a_far_guess() -> None:
    """The averaged slow motion of the paper, (4): vertical tangents at |V| = q."""

    def period_map(state: Vector) -> tuple[Vector, float]:
        v = float(np.clip(state[0], -1.0, 1.0))
        theta = np.arccos(v)
        drift = 1.0 - 2.0 / np.pi * theta - 2.0 / np.pi * np.sin(theta) * np.sin(0.7)
        return np.array([state[0] - 1e-3 * drift]), state[0]

    found = fixed_point(period_map, np.array([-0.97]), np.ones(1))
    assert isinstance(found, FixedPoint)
    theta = np.arccos(found.state[0])
    balance = 1.0 - 2.0 / np.pi * theta - 2.0 / np.pi * np.sin(theta) * np.sin(0.7)
    assert abs(balance) < 1e-9, f"the mean friction of (5) must vanish, is {balance:.1e}"


def test_saturated_drift_has_no_fixed_point() -> None:
    found = fixed_point(lambda s: (s - np.array([0.01, 0.0]), 0.0), np.zeros(2), ONES)
    assert isinstance(found, NoFixedPoint)
    assert found.status == "no_fixed_point"
    assert "drifts" in found.reason


def test_frictionless_slider_is_not_unique() -> None:
    found = fixed_point(lambda s: (s.copy(), float(s[0])), np.array([0.3, 0.0]), ONES)
    assert isinstance(found, NoFixedPoint)
    assert found.status == "not_unique"


def test_diverging_map_is_reported_as_not_converged() -> None:
    found = fixed_point(lambda s: (s + 1.0 + s**2, 0.0), np.array([0.1]), np.ones(1))
    assert isinstance(found, NoFixedPoint)
    assert found.status == "not_converged"
    assert "did not converge" in found.reason


@pytest.mark.parametrize(
    ("multiplier", "stability"), [(0.999, "stable"), (1.2, "unstable"), (-1.0, "neutral")]
)
def test_stability_follows_the_largest_multiplier(multiplier: float, stability: str) -> None:
    def period_map(state: Vector) -> tuple[Vector, float]:
        return np.array([multiplier, 0.1]) * state, 0.0

    found = fixed_point(period_map, np.array([0.5, 0.5]), ONES)
    assert isinstance(found, FixedPoint)
    assert found.stability == stability
    assert found.multipliers[0] == pytest.approx(multiplier, abs=1e-9)


def test_blocking_point_finds_the_load_that_stops_the_drift() -> None:
    """A damped slow velocity pushed by (0.0852 - load), resonator decoupled."""

    def period_map(state: Vector, load: float) -> tuple[Vector, float]:
        velocity = state[0] + 1e-3 * (0.0852 - load) - 1e-3 * state[0]
        return np.array([velocity, 0.3 * state[1]]), 1e-3 * (state[0] - 0.02 + state[1])

    found = blocking_point(period_map, np.array([0.3, 1.0]), 0.0, ONES, 0.1, 1e-3)
    assert isinstance(found, FixedPoint)
    assert found.load == pytest.approx(0.0652, rel=1e-9), "velocity 0.02 must balance the offset"
    assert abs(found.displacement) < 1e-15
    assert found.multipliers[0] == pytest.approx(0.999, abs=1e-8)


def test_blocking_point_of_a_map_without_motion_is_singular() -> None:
    found = blocking_point(lambda s, f: (0.5 * s, 0.0), np.ones(2), 0.1, ONES, 1.0, 1.0)
    assert isinstance(found, NoFixedPoint)
