from __future__ import annotations

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.steady_velocity import find_steady


def test_table_1_blocking_force_matches_taylor_integration(instance: Instance) -> None:
    blocking = find_blocking(instance, {})
    assert blocking.status == "blocked"
    assert blocking.blocking_force == pytest.approx(0.0851861, rel=1e-5)
    assert blocking.periods <= 100


@pytest.mark.parametrize("law", [{}, {"friction_law": 1.0}], ids=["Coulomb", "LuGre"])
@pytest.mark.parametrize(
    "values",
    [{"phase": 0.4}, {"friction_faces": 1.0}, {"fidelity": 1.0}, {"bristle_stiffness": 50.0}],
)
def test_blocking_force_stops_the_device(
    instance: Instance, values: dict[str, float], law: dict[str, float]
) -> None:
    values = {**values, **law}
    blocking = find_blocking(instance, values)
    assert blocking.blocking_force is not None
    motion = find_steady(instance, {**values, "load": blocking.blocking_force})
    assert motion.steady_velocity == pytest.approx(0.0, abs=1e-9)


def test_one_face_has_half_the_force_of_two(instance: Instance) -> None:
    one, two = (find_blocking(instance, {"friction_faces": n}).blocking_force for n in (1.0, 2.0))
    assert one is not None
    assert two == pytest.approx(2.0 * one, rel=1e-3), "(22) for each face"


def test_given_load_is_only_the_initial_guess(instance: Instance) -> None:
    blocking = find_blocking(instance, {"load": 0.19})
    assert blocking.blocking_force == pytest.approx(0.0851861, rel=1e-5)


@pytest.mark.parametrize(
    ("values", "status"),
    [
        ({"base_amplitude": 0.0, "normal_amplitude": 0.5}, "stuck"),
        ({"frequency_ratio": 1.001}, "slow_beat"),
        ({"frequency_ratio": 1.37}, "no_common_period"),
    ],
)
def test_missing_blocking_force_is_explained(
    instance: Instance, values: dict[str, float], status: str
) -> None:
    blocking = find_blocking(instance, values)
    assert blocking.blocking_force is None
    assert blocking.status == status
