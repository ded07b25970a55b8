from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.steady.newton import Vector, central_jacobian, solve


def test_central_jacobian_is_exact_for_quadratics() -> None:
    def function(x: Vector) -> Vector:
        return np.array([x[0] ** 2 + x[1], 3.0 * x[0] * x[1]])

    found = central_jacobian(function, np.array([2.0, -1.0]), np.array([0.1, 0.2]))
    assert found == pytest.approx(np.array([[4.0, 1.0], [-3.0, 6.0]]), abs=1e-12)


@pytest.mark.parametrize("scales", [(1.0, 1.0), (1e-6, 1e3)])
def test_scales_do_not_change_the_root_nor_the_work(scales: tuple[float, float]) -> None:
    size = np.array(scales)

    def function(x: Vector) -> Vector:
        y = x / size
        return np.asarray(size * [y[0] ** 2 + y[1] ** 2 - 5.0, y[0] * y[1] - 2.0])

    root = solve(function, np.array([3.0, 0.5]) * size, size)
    assert root.status == "converged"
    assert root.x / size == pytest.approx([2.0, 1.0], rel=1e-9)
    assert root.iterations < 10


def test_damping_converges_where_full_steps_diverge() -> None:
    root = solve(lambda x: np.arctan(x), np.array([5.0]), np.ones(1))
    assert root.status == "converged"
    assert abs(root.x[0]) < 1e-9


def test_triple_root_converges() -> None:
    """The averaged drift of a device with twice the frequency is nearly one of these."""
    root = solve(lambda x: x**3, np.array([0.5]), np.ones(1), tolerance=1e-4)
    assert root.status == "converged"
    assert abs(root.x[0]) < 1e-3


def test_function_without_a_zero_stalls() -> None:
    assert solve(lambda x: 1.0 + x**2, np.array([0.7]), np.ones(1)).status in ("stalled", "limit")


def test_singular_jacobian_has_a_residual_only_without_a_zero() -> None:
    family = solve(lambda x: np.array([0.0, x[1] - 1.0]), np.array([0.3, 0.0]), np.ones(2))
    assert family.status == "singular"
    assert family.residual < 1e-12, "every (x, 1) is a zero"
    none = solve(lambda x: np.array([0.5, x[1] - 1.0]), np.array([0.3, 0.0]), np.ones(2))
    assert none.status == "singular"
    assert none.residual == pytest.approx(0.5)


def test_rounding_noise_does_not_prevent_convergence() -> None:
    noise = iter(1e-11 * np.random.default_rng(0).standard_normal(1000))

    def function(x: Vector) -> Vector:
        return np.asarray(1e-2 * (x - 0.3) + next(noise))

    root = solve(function, np.array([2.0]), np.ones(1), tolerance=1e-10)
    assert root.status == "converged"
    assert root.x[0] == pytest.approx(0.3, abs=1e-7)
