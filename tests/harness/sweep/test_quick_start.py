from __future__ import annotations

from collections.abc import Iterator

import pytest

from harness.drive import Instance, instantiate
from harness.errors import FmuError, Refusal
from harness.fmu import Fmu
from harness.steady import find_steady
from harness.sweep.quick_start import QuickStart

VALUES = {"phase": 0.4, "fidelity": 1.0, "load": 0.02, "friction_law": 1.0, "drive_frequency": 3e3}


@pytest.fixture
def quick(fmu: Fmu) -> Iterator[QuickStart]:
    with instantiate(fmu) as owner:
        yield QuickStart(owner)


def test_starts_as_an_instance_does(quick: QuickStart, instance: Instance) -> None:
    for values in (VALUES, {}, {"load": 0.1}, VALUES):
        for one in (quick, instance):
            one.start(values)
            one.step_to(0.01)
        for name in ("phase", "fidelity", "load", "friction_law", "drive_frequency", "position"):
            assert quick.value(name) == instance.value(name), name
    assert find_steady(quick, {"phase": 1.0}) == find_steady(instance, {"phase": 1.0})


def test_refuses_as_an_instance_does_and_can_be_started_again(quick: QuickStart) -> None:
    with pytest.raises(Refusal, match="friction_coefficient = -1"):
        quick.start({"friction_coefficient": -1.0, "load": 0.1})
    with pytest.raises(FmuError, match="unknown parameter or input 'fase'"):
        quick.start({"fase": 1.0})
    with pytest.raises(FmuError, match=r"fidelity = 0\.5: allowed is an integer"):
        quick.start({"fidelity": 0.5})
    quick.start({})
    quick.step_to(0.001)
    assert quick.value("load") == 0.0
