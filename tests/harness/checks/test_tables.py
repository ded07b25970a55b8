"""The vocabulary of scene files and the functions behind it belong together."""

from slider_resonator.checks.expecting import EXPECTED
from slider_resonator.checks.fmu_side import PREDICTIONS
from slider_resonator.checks.measuring import MEASURES
from slider_resonator.device.interface import ALL_OUTPUTS
from slider_resonator.scenes.vocabulary import QUANTITIES


def test_every_quantity_has_its_measure_or_is_an_output() -> None:
    assert set(MEASURES) | set(PREDICTIONS) <= set(QUANTITIES)
    for name in QUANTITIES.keys() - MEASURES.keys():
        assert PREDICTIONS.get(name, name.removesuffix("_in_run")) in ALL_OUTPUTS


def test_every_reference_of_a_quantity_has_its_function() -> None:
    named = {name: set(quantity.references) for name, quantity in QUANTITIES.items()}
    assert {name: set(EXPECTED.get(name, {})) for name in QUANTITIES} == named
    assert set(EXPECTED) <= set(QUANTITIES)
