"""Newton's method for orbits: what it finds repeats, and its updates keep the secant condition."""

from __future__ import annotations

import pytest

from fmu_src.python.slider_component import orbit_newton
from fmu_src.python.slider_component.contact import FORWARD
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.held_orbit import held_orbit_at
from fmu_src.python.slider_component.linear_system import Matrix, Vector
from fmu_src.python.slider_component.orbit_equations import OrbitEquations, Trial
from fmu_src.python.slider_component.orbit_newton import MAX_MAPS, solved, unknowns_after
from fmu_src.python.slider_component.period_map import PeriodMap, period_map
from tests.fmu_src.orbit_devices import BRISTLES, STRONG, TABLE_1

SHARE = 0.3
"""Held velocity, over v_q."""
DEPARTURE = (0.02, -0.03, 0.01)
"""Change of the unknowns from the orbit to where the search begins, in their scales."""


def near_orbit(scales: PeriodMap) -> tuple[OrbitEquations, Vector, Trial]:
    """Equations of a held velocity, and unknowns off its orbit with their trial."""
    orbit = held_orbit_at(scales, 0.0, SHARE * scales.speed)
    equations = OrbitEquations(scales, 0.0, given=SHARE, theta=scales.section_phase(FORWARD))
    exact = equations.unknowns(orbit.section.state, orbit.section.bristle, -orbit.friction)
    unknowns = list(exact)
    for i, change in enumerate(DEPARTURE):
        unknowns[i] += change
    trial = equations.attempt(unknowns)
    assert trial is not None
    return equations, unknowns, trial


@pytest.mark.parametrize("device", [TABLE_1, STRONG, BRISTLES], ids=["table 1", "strong", "LuGre"])
def test_motion_repeats_at_the_held_velocity(device: Device) -> None:
    scales = period_map(device, 1.0, 1)
    equations, unknowns, trial = near_orbit(scales)
    solution = solved(equations, unknowns, trial, None)
    assert solution is not None
    again = equations.attempt(solution.unknowns)
    assert again is not None
    *changes, velocity = again.values
    accuracy = 1e-9 if scales.states > 3 else 1e-12
    assert max(map(abs, changes)) < accuracy, "the state repeats after a period"
    assert velocity == pytest.approx(SHARE, abs=accuracy), "the mean velocity is the held one"
    assert solution.mean_velocity == pytest.approx(SHARE, abs=accuracy)


def test_a_search_ends_within_its_number_of_maps(monkeypatch: pytest.MonkeyPatch) -> None:
    equations, unknowns, trial = near_orbit(period_map(TABLE_1, 1.0, 1))
    monkeypatch.setattr(orbit_newton, "MAX_MAPS", equations.maps + 2)
    assert solved(equations, unknowns, trial, None) is None, "two maps do not find an orbit"
    assert equations.maps <= MAX_MAPS


def test_the_updated_jacobian_maps_the_move_to_the_change() -> None:
    scales = period_map(TABLE_1, 1.0, 1)
    equations, unknowns, trial = near_orbit(scales)
    jacobian: Matrix | None = equations.jacobian(unknowns, trial)
    assert jacobian is not None
    step = [0.01, -0.02, 0.03, 0.005]
    following = unknowns_after(unknowns, step, 0.5)
    other = equations.attempt(following)
    assert other is not None
    updated = orbit_newton._updated(jacobian, unknowns, trial, following, other)
    for row, after, before in zip(updated, other.values, trial.values, strict=True):
        predicted = sum(a * 0.5 * b for a, b in zip(row, step, strict=True))
        assert predicted == pytest.approx(after - before, abs=1e-12), "Broyden's secant condition"
