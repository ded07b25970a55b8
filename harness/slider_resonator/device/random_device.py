"""Random devices over decades, the same on all platforms for the same generator."""

from random import Random


def decades(random: Random, low: float, high: float) -> float:
    """Return a number between two powers of ten, uniform in its logarithm."""
    return float(10.0 ** random.uniform(low, high))


def random_device(random: Random) -> dict[str, float]:
    """Return parameters of a device with Coulomb friction, by name, in SI units.

    In some the load reverses the contact, a tangential force drives, or the start is in motion.
    """
    w, mass = decades(random, 1.0, 5.0), decades(random, -3.0, 2.0)
    values: dict[str, float] = {
        "drive_frequency": w,
        "slider_mass": mass,
        "resonator_mass": mass * decades(random, -3.0, 0.5),
        "resonator_frequency": w * decades(random, -0.7, 0.7),
        "damping_ratio": random.choice((0.05, decades(random, -3.0, 0.3))),
        "base_amplitude": decades(random, -7.0, -2.0),
        "friction_coefficient": decades(random, -2.0, 1.0),
        "friction_faces": random.choice((1, 2)),
    }
    drive = values["resonator_mass"] * values["base_amplitude"] * w * w
    friction = drive * decades(random, -3.0, 0.5)
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
