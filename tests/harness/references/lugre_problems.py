"""Motions on bristles that tests of references share."""

from functools import partial
from typing import Any

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs

DURATION = 0.012
TIMES = np.linspace(0.0, DURATION, 121)


def constant(**inputs: Any) -> list[HeldInputs]:
    return [HeldInputs(0.0, DURATION, **inputs)]


SCHEDULE = [
    HeldInputs(0.0, 0.0031, phase=0.3),
    HeldInputs(0.0031, 0.0077, phase=1.9, load=0.1, frequency_ratio=2.0),
    HeldInputs(0.0077, DURATION, phase=-1.0, load=-0.05, frequency_ratio=1.37),
]

Lugre = partial(Device, friction_law=1)

PROBLEMS = {
    "table 1": (Lugre(), constant()),
    "soft": (Lugre(bristle_stiffness=1.0, bristle_damping=100.0), constant(load=0.05)),
    "undamped": (Lugre(bristle_stiffness=1e3, bristle_damping=0.0), constant()),
    "ratio 3": (Lugre(bristle_stiffness=1e4), constant(frequency_ratio=3.0, phase=0.4)),
    "ratio 1.37, lift-off": (Lugre(normal_amplitude=2.0), constant(frequency_ratio=1.37)),
    "presliding": (Lugre(base_amplitude=5e-8), constant()),
    "deep presliding": (Lugre(base_amplitude=1e-12, bristle_damping=100.0), constant()),
    "presliding, lift-off": (Lugre(base_amplitude=5e-8, normal_amplitude=2.0), constant()),
    "fidelity 1, lift-off": (Lugre(fidelity=1, normal_amplitude=2.0), constant(phase=0.4)),
    "one face": (Lugre(friction_faces=1, friction_coefficient=0.3), constant(phase=1.0)),
    "initial state": (
        Lugre(
            initial_position=0.01,
            initial_velocity=-0.2,
            initial_resonator_displacement=3e-4,
            initial_resonator_velocity=1.5,
            initial_bristle_deflection=4e-6,
        ),
        constant(),
    ),
    "schedule": (Lugre(), SCHEDULE),
}

STIFF = {
    "1e6": (Lugre(bristle_stiffness=1e6), constant(phase=0.4)),
    "1e8, presliding": (Lugre(bristle_stiffness=1e8, base_amplitude=5e-8), constant()),
    "1e8, deep presliding": (
        Lugre(bristle_stiffness=1e8, base_amplitude=1e-9, bristle_damping=0.0),
        constant(frequency_ratio=1.37),
    ),
}


def unit_device(kappa: float, frequency: float, amplitude_ratio: float) -> Device:
    """Model 2 of the paper with q = 1, mu = 0.4, sigma_1 = 1 at a stiffness number kappa.

    In its units x0 = 1 m, w0 = 1 rad/s: one mass, driven directly, on one face.
    """
    friction = 0.4
    return Device(
        slider_mass=1.0,
        resonator_mass=0.0,
        base_amplitude=0.0,
        tangential_force=frequency,
        drive_frequency=frequency,
        normal_amplitude=amplitude_ratio,
        friction_coefficient=friction,
        friction_faces=1,
        friction_law=1,
        bristle_stiffness=kappa * friction * frequency,
        bristle_damping=1.0,
        fidelity=1,
    )
