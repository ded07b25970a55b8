from __future__ import annotations

from slider_resonator.choosing.candidate import Candidate, models, tolerances
from slider_resonator.device.model import COULOMB, LUGRE, Model


def test_orders_of_averaging_are_models_of_their_own() -> None:
    found = models((COULOMB, LUGRE), (1, 2))
    assert [model.averaging_order for model in found] == [1, 1, 2, 2, None, None, None, None]
    assert len(set(found)) == 8
    assert [model.fidelity for model in models((COULOMB,), (None,))] == [0, 1, 2]


def test_an_fmu_without_orders_is_not_asked_for_one() -> None:
    assert "averaging_order" not in Candidate(Model(0, COULOMB), 1e-8, 1.0).parameters
    ordered = Candidate(Model(0, LUGRE, 2), 1e-8, 1.0)
    assert ordered.parameters["averaging_order"] == 2
    assert ordered.model.name == "fidelity 0, order 2, LuGre friction"


def test_leaps_have_a_tolerance_and_other_averages_none() -> None:
    found = {
        (m.friction_law, m.averaging_order): len(tolerances(m)) for m in models((0, 1), (1, 2))
    }
    assert found[LUGRE, 2] == found[COULOMB, 2] == found[LUGRE, None] > 1
    assert found[COULOMB, 1] == found[COULOMB, None] == found[LUGRE, 1] == 1
