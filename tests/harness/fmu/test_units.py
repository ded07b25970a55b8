"""A unit that differs from its name would scale every result unnoticed."""

from __future__ import annotations

from math import pi

import pytest
from fmpy.model_description import BaseUnit, DisplayUnit, Unit

from slider_resonator.device.interface import INPUTS, OUTPUTS, PARAMETERS
from slider_resonator.fmu.interface_check import DIMENSIONS, unit_problems

NEWTON = {"kg": 1, "m": 1, "s": -2}


def problems(unit: str, *displayed: DisplayUnit, **base: float) -> list[str]:
    return unit_problems(unit, [Unit(unit, BaseUnit(**base), list(displayed))])


def test_every_unit_of_the_interface_has_a_dimension() -> None:
    assert {*INPUTS.values(), *PARAMETERS.values(), *OUTPUTS.values()} <= set(DIMENSIONS)


def test_si_units_are_accepted() -> None:
    assert problems("N", **NEWTON) == []
    assert problems("m/s", m=1, s=-1) == []
    assert unit_problems("N", []) == [], "without a definition the name counts"
    assert unit_problems("N", [Unit("N")]) == []


@pytest.mark.parametrize("base", [{}, {"rad": 1}])
def test_the_radian_may_count_as_a_unit_or_as_1(base: dict[str, int]) -> None:
    assert problems("rad", **base) == []
    assert problems("rad/s", s=-1, **base) == []


@pytest.mark.parametrize(
    ("unit", "base", "message"),
    [
        ("N", {**NEWTON, "factor": 1000.0}, "unit N is defined with factor 1000.0, must be 1"),
        ("m", {"m": 1, "factor": 1e-3}, "unit m is defined with factor 0.001, must be 1"),
        ("rad", {"rad": 1, "factor": pi / 180.0}, "unit rad is defined with factor 0.01745"),
        ("m", {"m": 1, "offset": 2.0}, "unit m is defined with offset 2.0, must be 0"),
        ("m/s", {"m": 1, "s": -2}, "unit m/s is defined as m s^-2, must be m s^-1"),
        ("s/m", {"s": 1}, "unit s/m is defined as s, must be s m^-1"),
        ("1", {"K": 1}, "unit 1 is defined as K, must be 1"),
    ],
)
def test_another_definition_is_named(unit: str, base: dict[str, float], message: str) -> None:
    (problem,) = problems(unit, **base)
    assert problem.startswith(message)


def test_display_units_must_agree_with_their_names() -> None:
    rounded = DisplayUnit("deg", 57.29578)
    assert problems("rad", rounded, rad=1) == []
    assert problems("m", DisplayUnit("mm", 1e3), DisplayUnit("furlong", 7.0), m=1) == []
    assert problems("m", DisplayUnit("mm", 1.0), m=1) == [
        "display unit mm of unit m is defined with factor 1.0, must be 1000"
    ]
    (problem,) = problems("rad/s", DisplayUnit("Hz", 2.0 * pi), s=-1)
    assert problem.endswith("factor 6.283185307179586, must be 0.159154943")
    (problem,) = problems("N", DisplayUnit("mN", 1e3, 5.0), **NEWTON)
    assert problem.endswith("offset 5.0, must be 0")
