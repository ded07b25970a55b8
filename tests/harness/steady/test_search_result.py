from __future__ import annotations

import numpy as np

from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.periodic import FmuPeriodMap, read_facts
from slider_resonator.steady.search_result import cost, with_undamped_hint
from slider_resonator.steady.shooting import FixedPoint, NoFixedPoint


def test_search_cost_is_reported_as_far_as_known(instance: Instance) -> None:
    period_map = FmuPeriodMap(instance, {}, read_facts(instance, {}), 2)
    period_map(np.zeros(3), 0.0)
    assert cost(period_map, None) == {"common_period": 2, "periods": 2}
    failed = NoFixedPoint("not_converged", "why", 7, 1e-3)
    assert cost(period_map, failed)["iterations"] == 7
    assert "stable" not in cost(period_map, failed), "nothing was found that could be"
    found = FixedPoint(np.zeros(3), 0.0, 0.0, 3, 1e-14, np.array([0.5 + 0.1j]))
    assert cost(period_map, found)["stable"] is True
    assert cost(period_map, found)["multipliers"] == (0.5 + 0.1j,)


def test_undamped_resonator_is_mentioned_in_the_reason(instance: Instance) -> None:
    damped = read_facts(instance, {})
    assert with_undamped_hint("why", damped) == "why"
    undamped = read_facts(instance, {"damping_ratio": 0.0})
    assert "damping_ratio = 0" in with_undamped_hint("why", undamped)
