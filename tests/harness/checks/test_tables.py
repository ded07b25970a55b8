"""The vocabulary of scene files and the functions behind it belong together."""

from slider_resonator.checks.expecting import EXPECTED
from slider_resonator.checks.measuring import MEASURES
from slider_resonator.scenes.vocabulary import QUANTITIES


def test_every_quantity_has_its_measure() -> None:
    assert set(MEASURES) == set(QUANTITIES)


def test_every_reference_of_a_quantity_has_its_function() -> None:
    named = {name: set(quantity.references) for name, quantity in QUANTITIES.items()}
    assert {name: set(EXPECTED.get(name, {})) for name in QUANTITIES} == named
    assert set(EXPECTED) <= set(QUANTITIES)
