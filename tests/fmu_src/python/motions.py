"""Motions of the component without an FMU around it."""

from __future__ import annotations

import math

from fmu_src.python.slider_component.component import motion_of
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.parameters import Inputs

TABLE_1 = Device()
PERIOD = math.tau / 3500.0
"""Drive period of table 1 [s]."""
BLOCK = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)
"""A rigid block under constant normal load: friction 0.2 N on 1 kg."""


def begin(device: Device, inputs: Inputs | None = None, **state: float) -> Moment:
    """The first moment, as the device says but for what `state` does."""
    motion = motion_of(device, inputs or Inputs())
    moment = motion.start()
    for name, value in state.items():
        setattr(moment, name, value)
    moment.mode = motion.mode(moment)
    return moment


def after(
    duration: float, device: Device, inputs: Inputs | None = None, parts: int = 1, **state: float
) -> Moment:
    """The moment `duration` [s] after the first one, in equal parts."""
    motion, moment = motion_of(device, inputs or Inputs()), begin(device, inputs, **state)
    for _ in range(parts):
        moment = motion.advance(moment, duration / parts)
    return moment
