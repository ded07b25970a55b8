from __future__ import annotations

from dataclasses import replace

import pytest

from slider_resonator.choosing.candidate import TOLERANCES, Candidate, Model
from slider_resonator.choosing.cost import run_cost, search_cost
from slider_resonator.choosing.plan import Plan
from slider_resonator.choosing.scales import scales_of
from tests.harness.scene_text import scene_of


def plan(duration: float, steps: int, kicks: int = 0) -> Plan:
    """Return the plan of a run with so many changes of the load."""
    return Plan(duration, steps, kicks, kicks)


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


def test_leaps_cost_no_more_than_resolved_motion() -> None:
    scales = scales_of(scene_of(""))
    for steps in (1, 10, 1000, 100_000):
        leaping, resolved = (
            run_cost(Candidate(model, 1e-8, 1.0), scales, plan(20.0, steps))
            for model in (Model(0, 0, 2), Model(2, 0))
        )
        assert leaping <= resolved
        assert (leaping < 0.2 * resolved) == (steps < 100)


def test_stiff_bristles_cost_as_series_do_where_an_input_grows_along_a_line() -> None:
    scales, held = scales_of(scene_of("[device]\nfriction_law = 1\n")), plan(10.0, 10)
    line = replace(held, ramped=held.duration / scales.period)
    for fidelity in (1, 2):
        candidate = Candidate(Model(fidelity, 1), 1e-8, 1.0)
        costs = [run_cost(candidate, scales, one) for one in (held, line)]
        assert costs[1] > 1.5 * costs[0]
    soft = scales_of(scene_of("[device]\nfriction_law = 1\nbristle_stiffness = 1e3\n"))
    assert run_cost(candidate, soft, line) == run_cost(candidate, soft, held)
