"""Cases of random devices, with inputs, tunable parameters and step sizes that change in the run.

A case depends on seed and number alone, by the generator of the standard library, which is the same
on all platforms and versions of Python.
"""

from bisect import bisect_right
from collections.abc import Mapping
from itertools import pairwise
from math import log10, tau
from random import Random

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.device.model import Model
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.stressing.case import MODELS, RANDOM, Case, Hold

TUNABLES = (
    *("normal_preload", "normal_amplitude", "base_amplitude"),
    *("tangential_force", "friction_coefficient", "drive_frequency"),
)
"""Parameters that are tuned by up to a factor of two; the drive frequency by up to a tenth."""
RATIOS = (1.0, 2.0, 3.0, -1.0, -2.0, 0.0, 0.5, 1.5, 1.01, 1.0002, 0.97, 0.003)


def random_case(seed: int, number: int) -> Case:
    """Return a case of a seed; `number` counts from 0."""
    random = Random(f"{seed} {number}")
    model = MODELS[number % len(MODELS)]
    values = random_device(random) | model.parameters
    if model.leaps:
        values |= _light_friction(random, values)
    if model.friction_law == 1:
        values |= _bristles(random, values)
    holds = _holds(random, Device.from_mapping(values), model)
    start_time = random.choice((0.0, 0.0, 0.0, 1e-3, -5.0, 12.5, 1e4))
    return Case(RANDOM, f"seed {seed}, case {number}", model, values, holds, start_time)


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


def _light_friction(random: Random, values: Mapping[str, float]) -> dict[str, float]:
    """Return damping, friction and tolerance under which periods are leapt over."""
    damping = decades(random, log10(0.005), 0.0)  # transients must decay
    parameters = {**values, "damping_ratio": damping}
    device = Device.from_mapping(parameters)
    share = decades(random, -4.0, log10(0.03))  # of the drive force: slow motion
    friction = abs(equivalent_force(device).amplitude) * share
    preload = friction / (device.friction_faces * device.friction_coefficient)
    varies = device.normal_amplitude / device.normal_preload
    return parameters | {
        "normal_preload": preload,
        "normal_amplitude": preload * varies,
        "tolerance": decades(random, -9.0, -5.0),
    }


def _bristles(random: Random, values: Mapping[str, float]) -> dict[str, float]:
    """Return bristles from soft to hard, as the fast motion sees them."""
    device = Device.from_mapping(values)
    fast = equivalent_force(device).velocity_amplitude
    mu, w = device.friction_coefficient, device.drive_frequency
    stiffness = mu * w / fast * decades(random, -1.0, 3.0)
    return {
        "bristle_stiffness": stiffness,
        "bristle_damping": mu / fast * decades(random, -3.0, -0.3),
        "initial_bristle_deflection": random.choice(
            (0.0, random.uniform(-1.0, 1.0) * mu / stiffness)
        ),
        "tolerance": decades(random, -11.0, -6.0),
    }


def _times(random: Random, device: Device, model: Model) -> list[float]:
    """Return the communication points (s), at random or in equal steps with a shorter last one."""
    low, high = (3.0, 3000.0) if model.averages else (0.3, 30.0)
    if model.leaps:  # their reference is resolved
        low, high = 20.0, 800.0
    duration = tau / device.drive_frequency * decades(random, log10(low), log10(high))
    if model.averages and model.friction_law == 1:
        fast = equivalent_force(device).velocity_amplitude
        # Friction stops the fast velocity within a 20th of that.
        duration = min(duration, 20.0 * device.total_mass * fast / device.mean_friction)
    count = random.randint(1, 60)
    if model.leaps and random.random() < 0.5:  # long steps, of which periods are leapt over
        count = random.randint(1, 4)
    inside = sorted(random.uniform(0.0, 1.0) for _ in range(count - 1))
    if random.random() < 0.5:
        inside = [i / (count - random.uniform(0.1, 1.0)) for i in range(1, count)]
    shares = [0.0, *(t for t in inside if t < 1.0), 1.0]
    times: list[float] = np.unique(duration * np.array(shares)).tolist()
    return times


def _holds(random: Random, device: Device, model: Model) -> tuple[Hold, ...]:
    """Return steps whose inputs jump a few times, and whose parameters are tuned there."""
    times = _times(random, device, model)
    jumps = sorted({0, *(random.randrange(len(times)) for _ in range(random.randint(0, 4)))})
    starts = [jump for jump in jumps if jump < len(times) - 1]
    load = device.mean_friction * random.choice((0.0, 0.3, 1.2))
    ratios = (*RATIOS, random.uniform(-3.0, 5.0))
    ratio = random.choice(ratios)
    tuned: dict[str, list[float]] = {}
    if len(starts) > 1 and random.random() < 0.5:
        for name in random.sample(TUNABLES, random.randint(1, 6)):
            width = 0.04 if name == "drive_frequency" else 0.3
            first = float(getattr(device, name))
            tuned[name] = [first, *(first * decades(random, -width, width) for _ in starts[1:])]
    phases = [random.uniform(-10.0, 10.0) for _ in starts]
    loads = [load * random.uniform(-1.0, 1.0) for _ in starts]
    now = [ratio if random.random() < 0.7 else random.choice(ratios) for _ in starts]
    holds = []
    for index, (start, stop) in enumerate(pairwise(times)):
        part = bisect_right(starts, index) - 1
        changed = tuple((name, values[part]) for name, values in tuned.items())
        holds.append(Hold(stop - start, 1, phases[part], loads[part], now[part], changed))
    return tuple(holds)
