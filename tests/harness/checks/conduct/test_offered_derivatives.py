"""An FMU that offers derivatives which it does not have is noticed."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.checks.conduct.host_calls import derivative_offer_faults
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.opening import open_fmu
from tests.harness.faulty_fmus import redescribed

OFFERS = {
    "providesDirectionalDerivative": ("false", "true"),
    "maxOutputDerivativeOrder": ("1", "2"),
}


@pytest.mark.parametrize("offer", OFFERS)
def test_a_false_offer_is_a_fault(native_fmu: Path, tmp_path: Path, offer: str) -> None:
    true, false = (f'{offer}="{value}"'.encode() for value in OFFERS[offer])
    found = []
    for path in (native_fmu, redescribed(native_fmu, tmp_path / "other.fmu", true, false)):
        with open_fmu(path) as fmu:
            instance = Instance(fmu)
            instance.start({})
            found.append([*derivative_offer_faults(instance)])
            instance.end()
    sound, (fault,) = found
    assert sound == []
    assert fault.startswith(f"{offer} is {OFFERS[offer][1]}")
