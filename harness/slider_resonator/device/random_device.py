"""Random devices over decades, the same on all platforms for the same generator."""

from __future__ import annotations

from random import Random

FREQUENCIES = (1.0, 5.0)
"""Decades of the drive frequency, rad/s; the others below are decades, too."""
MASSES = (-3.0, 2.0)
RESONATOR_SHARES = (-3.0, 0.5)
"""Resonator mass over slider mass."""
DETUNINGS = (-0.7, 0.7)
"""Resonator frequency over drive frequency."""
DAMPING_RATIOS = (-3.0, 0.3)
AMPLITUDES = (-7.0, -2.0)
FRICTION_COEFFICIENTS = (-2.0, 1.0)
FRICTION_SHARES = (-3.0, 0.5)
"""Friction over the force of the base excitation."""


def decades(random: Random, low: float, high: float) -> float:
    """Return a number between two powers of ten, uniform in its logarithm."""
    return float(10.0 ** random.uniform(low, high))


def random_device(random: Random) -> dict[str, float]:
    """Return parameters of a device with Coulomb friction, by name, in SI units.

    In some the load reverses the contact, a tangential force drives, or the start is in motion.
    """
    w, mass = decades(random, *FREQUENCIES), decades(random, *MASSES)
    values: dict[str, float] = {
        "drive_frequency": w,
        "slider_mass": mass,
        "resonator_mass": mass * decades(random, *RESONATOR_SHARES),
        "resonator_frequency": w * decades(random, *DETUNINGS),
        "damping_ratio": random.choice((0.05, decades(random, *DAMPING_RATIOS))),
        "base_amplitude": decades(random, *AMPLITUDES),
        "friction_coefficient": decades(random, *FRICTION_COEFFICIENTS),
        "friction_faces": random.choice((1, 2)),
    }
    drive = values["resonator_mass"] * values["base_amplitude"] * w * w
    friction = drive * decades(random, *FRICTION_SHARES)
    preload = friction / (values["friction_faces"] * values["friction_coefficient"])
    share = random.choice((random.uniform(0.0, 1.0), random.uniform(1.0, 3.0), 1.0, 0.0))
    values |= {
        "normal_preload": preload,
        "normal_amplitude": preload * share,
        "tangential_force": random.choice((0.0, 0.0, drive * random.uniform(-1.0, 1.0))),
    }
    if random.random() < 0.3:
        swing = values["base_amplitude"]
        values |= {
            "initial_position": random.uniform(-1.0, 1.0),
            "initial_velocity": swing * w * random.uniform(-0.3, 0.3),
            "initial_resonator_displacement": swing * random.uniform(-3.0, 3.0),
            "initial_resonator_velocity": swing * w * random.uniform(-3.0, 3.0),
        }
    return values
