"""Newton, bracketing and shooting on functions and maps whose solutions are known."""

from collections.abc import Callable
from math import pi

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.steady.shooting import (
    NoPeriodicMotion,
    PeriodicRun,
    PeriodMap,
    blocked_point,
    bracketed_state,
    fixed_point,
    solve,
    steady_point,
)


@pytest.mark.parametrize("scales", [(1.0, 1.0), (1e-6, 1e3)])
def test_scales_do_not_change_the_root_nor_the_work(scales: tuple[float, float]) -> None:
    size = np.array(scales)

    def function(x: Array) -> Array:
        y = x / size
        return np.asarray(size * [y[0] ** 2 + y[1] ** 2 - 5.0, y[0] * y[1] - 2.0])

    zero, iterations, _ = solve(function, np.array([3.0, 0.5]) * size, size)
    assert zero / size == pytest.approx([2.0, 1.0], rel=1e-9)
    assert iterations < 10


@pytest.mark.parametrize(
    ("function", "start", "tolerance", "error"),
    [
        pytest.param(np.arctan, 5.0, 1e-11, 1e-9, id="full steps diverge"),
        # The averaged drift of a device with twice the frequency is nearly one of these.
        pytest.param(lambda x: x**3, 0.5, 1e-4, 1e-3, id="triple root"),
    ],
)
def test_damped_steps_converge(
    function: Callable[[Array], Array], start: float, tolerance: float, error: float
) -> None:
    zero, _, _ = solve(function, np.array([start]), np.ones(1), tolerance=tolerance)
    assert abs(zero[0]) < error


@pytest.mark.parametrize(("push", "status"), [(0.0, "not_unique"), (0.5, "no_fixed_point")])
def test_singular_jacobian_has_a_residual_only_without_a_zero(push: float, status: str) -> None:
    with pytest.raises(NoPeriodicMotion) as none:
        solve(lambda x: np.array([push, x[1] - 1.0]), np.array([0.3, 0.0]), np.ones(2))
    assert none.value.status == status
    assert none.value.residual == pytest.approx(push, abs=1e-12)


def saturated_map(state: Array) -> tuple[Array, float]:
    """A drift that saturates outside |v| < 1 with vertical tangents, beside a fast oscillator."""
    v, y, u = state
    inside = float(np.clip(v + 0.1 * y, -1.0, 1.0))
    drift = 0.97 - 2.0 / np.pi * np.arccos(inside)
    fast = np.array([[0.4, 0.5], [-0.5, 0.4]]) @ np.array([y - 0.2, u + 0.1])
    return np.array([v - 1e-3 * drift, 0.2 + fast[0], -0.1 + fast[1]]), v


def test_bracketing_finds_a_root_out_of_reach_of_newton() -> None:
    guess, scale = np.array([40.0, 1.0, 1.0]), np.ones(3)
    state = bracketed_state(saturated_map, guess, scale)
    assert state is not None
    assert np.abs(saturated_map(state)[0] - state).max() < 1e-12
    fixed_point(saturated_map, state, scale)  # Newton accepts what lies between the bounds


@pytest.mark.parametrize(
    ("period_map", "size"),
    [
        pytest.param(lambda s: (s - 1e-3, 0.0), 1, id="one-sided drift"),
        pytest.param(lambda s: (np.array([-s[0], s[1] + 1.0]), 0.0), 2, id="growing fast state"),
    ],
)
def test_there_is_no_bracket(period_map: PeriodMap, size: int) -> None:
    assert bracketed_state(period_map, np.zeros(size), np.ones(size)) is None


def test_bracketing_renews_its_jacobian_for_a_bristle_state() -> None:
    """As a soft bristle does: one Jacobian does not serve for all velocities."""

    def period_map(state: Array) -> tuple[Array, float]:
        v, bend = state
        held = np.exp(-abs(v))
        return np.array([v + 1e-3 * (0.3 - np.tanh(v)), bend * held + (1.0 - held) * v]), v

    state = bracketed_state(period_map, np.array([-0.05, 1.0]), np.array([3.0, 1.0]))
    assert state is not None
    assert state == pytest.approx(np.arctanh([0.3, 0.3]), abs=1e-9)


ONES = np.ones(2)


@pytest.mark.parametrize("slow", [0.5, 1.0 - 1.0 / 1140.0, 1.0 - 1e-6, -0.9])
def test_linear_contraction_is_solved_by_one_jacobian(slow: float) -> None:
    basis, target = np.array([[1.0, 0.3], [-0.2, 1.0]]), np.array([0.126667, -3.0])
    matrix = basis @ np.diag([slow, 0.2]) @ np.linalg.inv(basis)
    evaluations = []

    def period_map(state: Array) -> tuple[Array, float]:
        evaluations.append(state)
        return target + matrix @ (state - target), 2.0 * state[0]

    found = fixed_point(period_map, np.array([0.5, 1.0]), ONES)
    error = np.abs(found.state - target).max()
    assert error < 1e-9, f"a near-neutral direction must not cost accuracy: error {error:.1e}"
    assert found.displacement == pytest.approx(2.0 * target[0], rel=1e-8)
    assert np.abs(np.sort(found.multipliers.real) - np.sort([slow, 0.2])).max() < 1e-9
    assert found.stability == "stable"
    assert len(evaluations) <= 20, "a linear map needs one Jacobian and both neighbours"


def kinked(below: float, above: float) -> Callable[[Array], tuple[Array, float]]:
    """A slow direction with one multiplier below the fixed point and one above, and a fast one."""
    basis = np.array([[1.0, 0.3], [-0.2, 1.0]])

    def period_map(state: Array) -> tuple[Array, float]:
        slow, fast = np.linalg.solve(basis, state - 0.4)
        end = np.array([slow * (above if slow > 0.0 else below), 0.2 * fast + 0.1 * slow**2])
        return basis @ end + 0.4, 0.0

    return period_map


@pytest.mark.parametrize("sides", [(1.0, 0.99), (0.99, 1.0), (1.0, 1.0)])
def test_an_end_of_a_family_is_no_steady_motion(sides: tuple[float, float]) -> None:
    with pytest.raises(NoPeriodicMotion, match="a whole family of motions repeats"):
        fixed_point(kinked(*sides), np.array([0.5, 0.3]), ONES)


@pytest.mark.parametrize(
    ("sides", "stability"), [((0.9, 0.99), "stable"), ((1.1, 0.8), "unstable")]
)
def test_the_weaker_side_of_a_kink_counts(sides: tuple[float, float], stability: str) -> None:
    found = fixed_point(kinked(*sides), np.array([0.5, 0.3]), ONES)
    assert found.multipliers[0] == pytest.approx(max(sides), rel=1e-6)
    assert found.stability == stability


def test_saturated_drift_has_no_fixed_point() -> None:
    with pytest.raises(NoPeriodicMotion, match="drifts") as none:
        fixed_point(lambda s: (s - np.array([0.01, 0.0]), 0.0), np.zeros(2), ONES)
    assert none.value.status == "no_fixed_point"


@pytest.mark.parametrize(
    ("multiplier", "stability"), [(0.999, "stable"), (1.2, "unstable"), (-1.0, "neutral")]
)
def test_stability_follows_the_largest_multiplier(multiplier: float, stability: str) -> None:
    def period_map(state: Array) -> tuple[Array, float]:
        return np.array([multiplier, 0.1]) * state, 0.0

    found = fixed_point(period_map, np.array([0.5, 0.5]), ONES)
    assert found.stability == stability
    assert found.multipliers[0] == pytest.approx(multiplier, abs=1e-9)


class _Slider(PeriodicRun):
    """A slow velocity that (0.1 - load) pushes, saturated as Coulomb friction is, and a swing."""

    device = Device(drive_frequency=pi)
    drive_periods = 1

    def run(self, state: Array, load: float, periods: int, samples: int = 1) -> tuple[Array, Array]:
        drift = 0.01 * (0.1 - load - np.clip(state[0], -0.5, 0.5))
        travel = periods * self.drive_period * state[:1]
        return np.array([[state[0] + drift, 0.3 * state[1]]]), travel

    def scale(self, sizes: Array) -> Array:
        return np.ones_like(sizes)

    def warm_up(self, velocity: float, load: float) -> tuple[Array, Array]:
        return np.array([velocity + 0.01, 0.1]), np.ones(2)


@pytest.mark.parametrize("velocity", [0.0, 0.3, 40.0])
def test_steady_motion_is_found_from_any_guess(velocity: float) -> None:
    found = steady_point(_Slider(), velocity, 0.03)
    assert found.displacement / _Slider().period == pytest.approx(0.07, abs=1e-9)


def test_the_load_that_stops_the_drift_is_found() -> None:
    load, found = blocked_point(_Slider(), *_Slider().warm_up(0.0, 0.0), 0.0, 0.2)
    assert load == pytest.approx(0.1, abs=1e-10)
    assert found.displacement == pytest.approx(0.0, abs=1e-10)
    assert found.multipliers[0] == pytest.approx(0.99, abs=1e-8)


def test_no_load_blocks_what_does_not_move(monkeypatch: pytest.MonkeyPatch) -> None:
    """A state that decays without any motion."""
    monkeypatch.setattr(_Slider, "run", lambda _, state, *__: (0.5 * state[None], np.zeros(1)))
    with pytest.raises(NoPeriodicMotion):
        blocked_point(_Slider(), np.ones(2), np.ones(2), 0.1, 1.0)


def test_bounds_that_change_sides_by_rounding_are_no_bracket() -> None:
    """Each bound is computed again, and then the state grows at both."""
    grows = iter([True, False, True, True])

    def period_map(state: Array) -> tuple[Array, float]:
        return state + (1e-16 if next(grows) else -1e-16), 0.0

    assert bracketed_state(period_map, np.zeros(1), np.full(1, 1e-3)) is None
