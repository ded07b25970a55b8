"""Shooting with any integrator, within a budget."""

from __future__ import annotations

from math import inf

import pytest

from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.peer_methods import shoot
from tests.harness.trading.problems import TABLE_1, problem


def test_any_integrator_can_be_shot_with() -> None:
    table_1 = problem(TABLE_1)
    _, found = shoot(table_1, "steady_velocity", simulate, 1e-9, inf)
    assert found.value == pytest.approx(0.12666700, rel=1e-7)
    assert 30 <= found.periods <= 100, "a long run needs thousands"
    with pytest.raises(RuntimeError, match="more than its budget of 0 s"):
        shoot(table_1, "steady_velocity", simulate, 1e-9, 0.0)
