from __future__ import annotations

from slider_resonator.choosing.candidate import Model
from slider_resonator.choosing.resolved_cost import period_cost
from slider_resonator.choosing.scales import scales_of
from tests.harness.scene_text import scene_of


def test_stiff_bristles_cost_less_than_those_that_bend_in_part_of_a_period() -> None:
    costs = [
        period_cost(Model(2, 1), 1e-8, scales_of(scene_of(f"[device]\nbristle_stiffness = {s}\n")))
        for s in (1e4, 1e5, 1e7)
    ]
    assert costs[0] > 2.0 * costs[1] > 2.0 * costs[2]
