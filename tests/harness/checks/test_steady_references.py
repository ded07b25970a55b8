from __future__ import annotations

import pytest

from slider_resonator.checks.steady_references import SteadyReferences
from slider_resonator.device.device import Device

TABLE_1 = SteadyReferences(Device(), phase=0.0, load=0.0, frequency_ratio=1.0)


@pytest.mark.parametrize("name", ["averaged_velocity", "averaged_blocking_force"])
def test_closed_forms_hold_for_equal_frequencies_only(name: str) -> None:
    with pytest.raises(ValueError, match=r"frequency_ratio = 3.0"):
        getattr(SteadyReferences(Device(), 0.0, 0.0, frequency_ratio=3.0), name)


@pytest.mark.parametrize("ratio", [1.02, 2.98])
def test_the_difference_frequency_counts_from_the_nearest_multiple(ratio: float) -> None:
    references = SteadyReferences(Device(), 0.0, 0.0, frequency_ratio=ratio)
    assert references.difference_frequency == pytest.approx(11.1408460, rel=1e-7)


@pytest.mark.parametrize("law", [0, 1])
def test_predictions_for_table_1_are_the_averages(law: int) -> None:
    device = Device(friction_law=law, bristle_stiffness=1e10)
    references = SteadyReferences(device, 0.0, 0.0, frequency_ratio=1.0)
    assert references.predicted_velocity == pytest.approx(0.126731, rel=2e-3), (
        "LuGre friction on hard bristles is Coulomb friction"
    )
    assert references.predicted_blocking_force == pytest.approx(0.085222, rel=2e-3)


def test_predictions_hold_for_other_ratios_and_lifting_contacts() -> None:
    ratio_3 = SteadyReferences(Device(), 0.4, 0.0, frequency_ratio=3.0)
    assert ratio_3.predicted_velocity == pytest.approx(-0.0362968, abs=2e-4)
    lifting = SteadyReferences(Device(normal_amplitude=2.0), 0.4, 0.0, frequency_ratio=1.0)
    assert lifting.steady_velocity == pytest.approx(lifting.predicted_velocity, abs=1e-3)
