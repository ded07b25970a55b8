from __future__ import annotations

from dataclasses import replace
from math import tau

import pytest

from slider_resonator.studies.choose.candidate import TOLERANCES, Candidate, Model
from slider_resonator.studies.choose.cost import run_cost, search_cost
from slider_resonator.studies.choose.plan import Plan, Stay
from slider_resonator.studies.choose.scales import scales_of
from tests.harness.scene_text import scene_of


def plan(duration: float, steps: int, kicks: int = 0, leads: int = 0) -> Plan:
    """Return the plan of so many changes, of which some are of the phase, at equal distances."""
    periods = duration * 3500.0 / tau / (leads + 1.0)
    stays = tuple(Stay(periods, (0.1 * lead, 1.0), drifts=False) for lead in range(leads + 1))
    return Plan(duration, steps, kicks, kicks, stays)


def test_higher_accuracy_costs_more() -> None:
    scales = scales_of(scene_of(""))
    models = [Model(fidelity, law) for law in (0, 1) for fidelity in (0, 1, 2)]
    costs = [run_cost(Candidate(model, 1e-8, 1.0), scales, plan(10.0, 10)) for model in models]
    assert costs[0] < costs[1] < costs[2] < costs[4] < costs[5]
    assert costs[0] < costs[3] < costs[4]
    tolerances = [
        run_cost(Candidate(models[5], t, 1.0), scales, plan(10.0, 10)) for t in TOLERANCES
    ]
    assert tolerances == sorted(tolerances)


def test_resolved_motion_costs_by_the_period_and_averaged_motion_does_not() -> None:
    slow = scales_of(scene_of(""))
    fast = scales_of(
        scene_of(
            "[device]\ndrive_frequency = 35000.0\nresonator_frequency = 35000.0\n"
            "base_amplitude = 1e-5\n",
        )
    )
    resolved, averaged = (Candidate(Model(fidelity, 0), 1e-8, 100.0) for fidelity in (2, 0))
    for candidate, ratio in ((resolved, 10.0), (averaged, 1.0)):
        costs = [run_cost(candidate, scales, plan(100.0, 1)) for scales in (fast, slow)]
        assert costs[0] / costs[1] == pytest.approx(ratio, rel=1e-2)


def test_a_search_costs_more_than_the_output_of_the_theory() -> None:
    scales = scales_of(scene_of("[device]\nfriction_law = 1\n"))
    for law in (0, 1):
        costs = [search_cost(Model(fidelity, law), 1e-8, 40, scales) for fidelity in (0, 1, 2)]
        assert 8.0 * costs[0] < costs[1] <= costs[2]


def test_inputs_that_change_cost_averaged_motion_its_transients() -> None:
    scales = scales_of(scene_of(""))
    candidate = Candidate(Model(0, 0), 1e-8, 100.0)
    costs = [run_cost(candidate, scales, plan(100.0, 10, changes)) for changes in (0, 1, 5)]
    assert costs == sorted(costs)
    assert costs[2] - costs[0] == pytest.approx(5.0 * (costs[1] - costs[0]), rel=0.1)


def test_second_order_costs_its_orbits_and_a_resolved_start() -> None:
    damped, weakly = (
        scales_of(scene_of(f"[device]\ndamping_ratio = {ratio}\n")) for ratio in (0.05, 0.005)
    )
    first, second = (Candidate(Model(0, 0, order), 1e-8, 100.0) for order in (1, 2))
    costs = [run_cost(second, scales, plan(10.0, 1)) for scales in (damped, weakly)]
    assert run_cost(first, damped, plan(10.0, 1)) < costs[0] < costs[1]
    jumps = [run_cost(second, damped, plan(10.0, 1, 4, leads)) for leads in (0, 1, 2)]
    assert jumps[2] - jumps[1] == pytest.approx(jumps[1] - jumps[0], rel=1e-6)
    assert jumps[0] < jumps[1]


def test_orbits_at_the_edge_of_turning_back_cost_more() -> None:
    scales, second = scales_of(scene_of("")), Candidate(Model(0, 0, 2), 1e-8, 100.0)
    costs = [run_cost(second, scales, plan(10.0, 1), slow) for slow in ((0.1, 0.6), (0.1, 0.99))]
    assert costs[1] > 3.0 * costs[0]


def test_a_lead_that_drifts_is_searched_at_first_which_costs_more_than_tables() -> None:
    scales, second = scales_of(scene_of("")), Candidate(Model(0, 0, 2), 1e-8, 100.0)

    def cost(drifts: bool) -> float:
        stays = (Stay(4000.0, (0.0, 1.0), drifts=drifts),)
        return run_cost(second, scales, Plan(4000.0 * scales.period, 400, stays=stays))

    assert cost(drifts=True) > 3.0 * cost(drifts=False)


def test_leads_of_a_series_cost_a_curve_each_where_those_of_a_few_curves_are_kept() -> None:
    scales, second = scales_of(scene_of("")), Candidate(Model(0, 0, 2), 1e-8, 100.0)

    def cost(leads: int) -> float:
        stays = tuple(Stay(2e4, (0.1 * (i % leads), 1.0), drifts=False) for i in range(40))
        return run_cost(second, scales, Plan(8e5 * scales.period, 40, stays=stays))

    assert cost(6) > 2.0 * cost(4)


def orbits_cost(stiffness: float, drifts: bool) -> float:
    """Return the cost of averages of second order on bristles over 4000 drive periods."""
    device = f"[device]\nfriction_law = 1\nbristle_stiffness = {stiffness}\n"
    scales = scales_of(scene_of(device))
    plan = Plan(4000.0 * scales.period, 400, stays=(Stay(4000.0, (0.0, 1.0), drifts=drifts),))
    return run_cost(Candidate(Model(0, 1, 2), 1e-8, 100.0), scales, plan)


@pytest.mark.parametrize(("drifts", "least"), [(False, 1.1), (True, 1.4)])
def test_orbits_cost_as_the_motion_of_the_bristle_does(drifts: bool, least: float) -> None:
    soft, bending, stiff = (orbits_cost(stiffness, drifts) for stiffness in (1.5e3, 1.5e4, 1e7))
    assert bending > soft > least * stiff


def test_orbits_cost_more_where_friction_takes_more_of_the_drive() -> None:
    second, costs = Candidate(Model(0, 0, 2), 1e-8, 100.0), []
    for friction in (0.1, 5.0):
        scales = scales_of(scene_of(f"[device]\nfriction_coefficient = {friction}\n"))
        costs.append(run_cost(second, scales, plan(10.0, 1)))
    assert costs[1] > 2.0 * costs[0]


def test_steps_cost_more_until_the_slow_velocity_has_settled() -> None:
    scales, second = scales_of(scene_of("")), Candidate(Model(0, 0, 2), 1e-8, 100.0)

    def step(duration: float) -> float:
        few, many = (run_cost(second, scales, plan(duration, n)) for n in (1000, 2000))
        return (many - few) / 1000.0

    assert step(10.0) > 1.3 * step(1000.0)


def test_stiff_bristles_cost_as_series_do_where_an_input_grows_along_a_line() -> None:
    scales, held = scales_of(scene_of("[device]\nfriction_law = 1\n")), plan(10.0, 10)
    line = replace(held, ramped=held.duration / scales.period)
    for fidelity in (1, 2):
        candidate = Candidate(Model(fidelity, 1), 1e-8, 1.0)
        costs = [run_cost(candidate, scales, one) for one in (held, line)]
        assert costs[1] > 1.5 * costs[0]
    soft = scales_of(scene_of("[device]\nfriction_law = 1\nbristle_stiffness = 1e3\n"))
    assert run_cost(candidate, soft, line) == run_cost(candidate, soft, held)
