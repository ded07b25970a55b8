"""Up to the departure time a slider released from a stick moves on in its direction."""

from __future__ import annotations

from dataclasses import replace

import pytest

from fmu_src.python.slider_component.contact import BACKWARD, FORWARD, STICK
from fmu_src.python.slider_component.departure import departure_time
from fmu_src.python.slider_component.device import Device, Inputs
from fmu_src.python.slider_component.law import law_of
from fmu_src.python.slider_component.motion import State
from fmu_src.python.slider_component.regular_slide import RegularSlide

STICKING = Device(base_amplitude=5e-8)


@pytest.mark.parametrize("fidelity", [1, 2])
@pytest.mark.parametrize("damping", [0.05, 1.7])
def test_moves_on_until_then(fidelity: int, damping: float) -> None:
    law = law_of(replace(STICKING, fidelity=fidelity, damping_ratio=damping), Inputs())
    plant = law.held.plant
    moment, releases = law.start(State(0.0, 0.0, 0.0), 0.0), 0
    for _ in range(3000):
        before, moment = moment, law.advance(moment, 2e-6)
        if before.mode != STICK or moment.mode not in (FORWARD, BACKWARD):
            continue
        releases += 1
        at_release = law.advance(before, 2e-6 - moment.event_age)
        state = State(0.0, at_release.state.displacement, at_release.state.rate)
        chi = at_release.psi + plant.phase
        time = departure_time(plant, moment.mode, state, at_release.theta, chi)
        slide = RegularSlide(plant, moment.mode, state, at_release.theta, chi, moment.mode)
        assert time > 0.0, "a released slider departs"
        for i in range(1, 50):
            assert moment.mode * slide.state(time * i / 50).velocity > 0.0
    assert releases >= 2
