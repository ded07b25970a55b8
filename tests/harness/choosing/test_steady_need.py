from __future__ import annotations

from math import inf

import pytest

from slider_resonator.choosing.candidate import Candidate
from slider_resonator.choosing.steady_need import SteadyValue, find, steady_error
from slider_resonator.device.model import Model
from slider_resonator.fmu.instance import Instance


@pytest.mark.parametrize(
    ("fidelity", "order", "velocity", "force"),
    [
        (0, 1, 0.126731, 0.085222),
        (0, 2, 0.12666700, 0.0851861),
        (2, None, 0.12666700, 0.0851861),
    ],
)
def test_table_1_by_theory_and_by_shooting(
    instance: Instance, fidelity: int, order: int | None, velocity: float, force: float
) -> None:
    """The design's figures: (5) and its blocking force, and those of two degrees of freedom."""
    candidate = Candidate(Model(fidelity, 0, order), 1e-8, None)
    for name, value in (("steady_velocity", velocity), ("blocking_force", force)):
        found = find(instance, {"load": 0.0}, name, candidate)
        assert found.value == pytest.approx(value, rel=1e-5)
        assert (found.periods > 0) == (fidelity == 2)


def test_a_device_that_does_not_settle_has_no_value_and_a_reason(instance: Instance) -> None:
    candidate = Candidate(Model(2, 0), 1e-8, None)
    found = find(instance, {"frequency_ratio": 1.0001}, "steady_velocity", candidate)
    assert found.value is None
    assert "slow_beat" in found.reason


def test_the_error_of_a_value_is_at_least_that_of_the_search() -> None:
    reference, near, none = (
        SteadyValue(2.0, "", 9, 0.1),
        SteadyValue(2.5, "", 0, 0.1),
        SteadyValue(None, "stuck: why", 0, 0.1),
    )
    assert steady_error(near, reference, 0).error == 0.5
    assert steady_error(reference, reference, 0).error == pytest.approx(2e-10)
    assert steady_error(none, reference, 0).error == inf
    assert steady_error(near, none, 0).reason == "stuck: why"
