"""Values are checked against the table; the message names variable, value and requirement."""

from __future__ import annotations

import math
from dataclasses import fields

import pytest

from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.outputs import OUTPUTS
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.values import BY_NAME, SETTABLE, Refusal, checked
from fmu_src.python.slider_component.variables import VARIABLES


def test_the_table_is_the_interface() -> None:
    """Device, inputs and outputs have the names and starts of the table, and no others."""
    device = {f.name: getattr(Device(), f.name) for f in fields(Device)}
    inputs = {f.name: getattr(Inputs(), f.name) for f in fields(Inputs)}
    table = {c: {v.name: v.start for v in VARIABLES if v.causality == c} for c in
             ("parameter", "input", "output")}  # fmt: skip
    assert table["parameter"] == device
    assert table["input"] == inputs
    assert set(table["output"]) == set(OUTPUTS)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, "1", True, None])
def test_values_that_are_not_finite_are_refused(value: object) -> None:
    for name in (v.name for v in SETTABLE):
        with pytest.raises(Refusal, match=rf"{name} = .* refused: must be (a finite|an integer)"):
            checked(BY_NAME[name], value)


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("friction_faces", 1.5, "must be an integer from 1 to 2"),
        ("tolerance", 0.1, "must be a finite number from 1e-14 to 0.01"),
    ],
)
def test_refused_by_name(name: str, value: float, reason: str) -> None:
    with pytest.raises(Refusal, match=f"{name} = {value!r} refused: {reason}"):
        checked(BY_NAME[name], value)


def test_starts_are_accepted() -> None:
    for variable in SETTABLE:
        assert checked(variable, variable.start) == variable.start
