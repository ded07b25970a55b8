"""Motions of the component without an FMU around it."""

from __future__ import annotations

import math

from fmu_src.python.slider_component.device import Device, Inputs
from fmu_src.python.slider_component.law import law_of
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.motion import State

TABLE_1 = Device()
PERIOD = math.tau / 3500.0
"""Drive period of table 1 [s]."""
REST = State(0.0, 0.0, 0.0)
BLOCK = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)
"""A rigid block under constant normal load: friction 0.2 N on 1 kg."""


def begin(device: Device, inputs: Inputs | None = None, **state: float) -> Moment:
    """The first moment, at rest but for what `state` says."""
    return law_of(device, inputs or Inputs()).start(REST._replace(**state), 0.0)


def after(
    duration: float, device: Device, inputs: Inputs | None = None, parts: int = 1, **state: float
) -> Moment:
    """The moment `duration` [s] after the first one, in equal parts."""
    law, moment = law_of(device, inputs or Inputs()), begin(device, inputs, **state)
    for _ in range(parts):
        moment = law.advance(moment, duration / parts)
    return moment
