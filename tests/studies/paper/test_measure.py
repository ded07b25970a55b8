from __future__ import annotations

import pytest

from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.uniform_average import LugreCase
from studies.paper import slow_theory
from studies.paper.mapping import coulomb_case, lugre_case
from studies.paper.measure import blocking_force, plain, record, steady_velocity


def test_a_record_covers_the_span(instance: Instance) -> None:
    run = record(instance, coulomb_case(1.0, 10.0), 2.0, 8)
    assert run.times.tolist() == [0.25 * k for k in range(9)]
    assert run["position"][0] == 0.0
    assert set(plain(run)) == {"time", "position", "velocity"}


def test_no_steady_motion_is_an_error_with_its_reason(instance: Instance) -> None:
    with pytest.raises(FmuError, match="friction"):
        steady_velocity(instance, {**coulomb_case(1.0, 200.0), "load": 2.0})
    with pytest.raises(FmuError, match="no p/q"):
        blocking_force(instance, {**coulomb_case(1.0, 200.0), "frequency_ratio": 1.001})


def test_coulomb_cases_meet_theory(instance: Instance) -> None:
    values = coulomb_case(1.0, 1000.0, 0.8, 1.0)
    theory = slow_theory.steady_velocity(1.0, 0.8, 1.0)
    assert steady_velocity(instance, values) == pytest.approx(theory, abs=2e-3)
    blocked = slow_theory.blocking_load(0.8, 1.0)
    assert blocking_force(instance, values) == pytest.approx(blocked, abs=2e-3)


@pytest.mark.parametrize("stiffness", [10.0, 1000.0, 1e5])
def test_lugre_cases_meet_the_uniform_average(instance: Instance, stiffness: float) -> None:
    case = LugreCase()
    values = lugre_case(case, 1000.0, stiffness)
    average = slow_theory.uniform_velocity(case, stiffness, 1000.0)
    assert steady_velocity(instance, values) == pytest.approx(average, abs=2e-3)
    blocked = slow_theory.uniform_blocking_load(case, stiffness, 1000.0)
    assert blocking_force(instance, values) == pytest.approx(blocked, abs=2e-3)
