"""Devices whose held orbits are compared, and random ones."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, fields, replace

from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.period_map import PeriodMap, period_map
from slider_resonator.device.device import Device as ReferenceDevice
from slider_resonator.references.closed_forms import equivalent_force

TABLE_1 = Device()
STRONG = replace(TABLE_1, friction_coefficient=5.0)
FLIGHT = replace(TABLE_1, friction_coefficient=1.0, normal_amplitude=1.8)
BRISTLES = replace(TABLE_1, friction_law=1, tolerance=1e-10)
STICKING = replace(TABLE_1, friction_coefficient=150.0, normal_amplitude=0.5)
SOFT_BRISTLE = Device(
    slider_mass=0.0096,
    resonator_mass=0.0192,
    resonator_frequency=23.6,
    damping_ratio=0.05,
    base_amplitude=3.54e-4,
    drive_frequency=10.9,
    friction_coefficient=0.72,
    friction_faces=1,
    friction_law=1,
    normal_preload=4.77e-5,
    normal_amplitude=4.77e-5,
    bristle_stiffness=558.0,
    bristle_damping=8.2,
)
"""Where its load is largest, the slider swings on its bristles as slowly as they follow."""


@dataclass(frozen=True)
class Case:
    """A device, the phase of its normal load (rad), waves and turns of it; `share` is V / v_q."""

    device: Device
    lead: float
    ratio: float
    turns: int
    share: float

    @property
    def map(self) -> PeriodMap:
        return period_map(self.device, self.ratio, self.turns)


def as_reference(device: Device) -> ReferenceDevice:
    names = {field.name for field in fields(ReferenceDevice)}
    values = {f.name: getattr(device, f.name) for f in fields(Device) if f.name in names}
    return ReferenceDevice(**values)


def random_case(seed: int, friction_share: float = 0.1) -> Case:
    """A device with friction up to a share of the drive force; both laws, flight, p/q."""
    draw = random.Random(seed)

    def decades(low: float, high: float) -> float:
        return math.exp(draw.uniform(math.log(low), math.log(high)))

    mass, frequency = decades(0.1, 10.0), decades(300.0, 30_000.0)
    device = Device(
        slider_mass=mass,
        resonator_mass=mass * decades(0.01, 0.5),
        resonator_frequency=frequency * decades(0.4, 2.5),
        damping_ratio=decades(0.005, 1.0),
        base_amplitude=decades(1e-6, 1e-3),
        drive_frequency=frequency,
        friction_coefficient=decades(0.02, 1.0),
        friction_law=draw.choice([0, 1]),
        tolerance=1e-10,
    )
    drive = device.resonator_mass * device.base_amplitude * frequency**2
    preload = decades(1e-3, friction_share) * drive / (2.0 * device.friction_coefficient)
    alpha = draw.uniform(0.0, 1.9)
    ratios = [(1.0, 1)] * 4 + [(2.0, 1), (3.0, 1)] + ([(1.5, 2), (0.5, 2)] if alpha > 1.0 else [])
    ratio, turns = draw.choice(ratios)
    force = equivalent_force(as_reference(device))
    device = replace(
        device,
        normal_preload=preload,
        normal_amplitude=alpha * preload,
        bristle_stiffness=decades(1.0, 1e4) * device.friction_coefficient / force.ripple_amplitude,
        bristle_damping=draw.uniform(0.0, 0.3)
        * device.friction_coefficient
        / force.velocity_amplitude,
    )
    return Case(device, draw.uniform(-3.1, 3.1), ratio, turns, draw.uniform(-1.1, 1.1))
