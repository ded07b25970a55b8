"""The cases of a campaign: devices over decades, with schedules of all inputs and tunables.

A case depends on seed and number alone, by the generator of the standard library, which is the same
on all platforms and versions of Python.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import log10, tau
from random import Random

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.device.schedule import Schedule
from slider_resonator.device.signal import Signal
from slider_resonator.references.closed_forms import equivalent_force

MODELS = (
    *((2, 0, 2), (1, 0, 2), (0, 0, 1), (2, 1, 2), (1, 1, 2), (0, 1, 1)),
    *((0, 0, 2), (0, 1, 2)),
)
"""Fidelity, friction law and order of averages, in turn."""
RESOLVED_PERIODS = (0.3, 30.0)
AVERAGED_PERIODS = (3.0, 3000.0)
"""Shortest and longest run, in drive periods."""
SECOND_ORDER_PERIODS = (20.0, 800.0)
"""The same with averages of second order, whose reference is resolved."""
SECOND_ORDER_STEPS = 4
"""Most steps of half of these runs: long ones, of which periods are leapt over."""
LEAP_TOLERANCES = (1e-9, 1e-5)
FRICTION_SHARES = (1e-4, 0.03)
"""Friction over the drive force with averages of second order: slow motion."""
MIN_DAMPING = 0.005
"""Smallest damping ratio with them: transients must decay."""
MAX_LUGRE_RELAXATIONS = 20.0
"""Longest averaged run with LuGre friction, in times in which friction stops the fast velocity."""
TUNABLES = (
    *("normal_preload", "normal_amplitude", "base_amplitude"),
    *("tangential_force", "friction_coefficient"),
)
"""Parameters that are tuned by up to a factor of two; the drive frequency by up to a tenth."""
RATIOS = (1.0, 2.0, 3.0, -1.0, -2.0, 0.0, 0.5, 1.5, 1.01, 1.0002, 0.97, 0.003)
START_TIMES = (0.0, 0.0, 0.0, 1e-3, -5.0, 12.5, 1e4)


@dataclass(frozen=True)
class RandomCase:
    """A run: `parameters` at the start, and the `schedule` of inputs and tunables."""

    seed: int
    number: int
    parameters: Mapping[str, float]
    schedule: Schedule

    @property
    def device(self) -> Device:
        """The device at the start."""
        return Device.from_mapping(self.parameters)

    @property
    def model(self) -> str:
        """Fidelity and friction law in words."""
        law = "LuGre" if self.parameters["friction_law"] else "Coulomb"
        order = ", order 2" if self.second_order else ""
        return f"{law}, fidelity {self.parameters['fidelity']:g}{order}"

    @property
    def second_order(self) -> bool:
        """Whether it is motion by averages of second order."""
        return self.parameters["fidelity"] == 0 and self.parameters["averaging_order"] == 2


def random_case(seed: int, number: int) -> RandomCase:
    """Return a case of a campaign; `number` counts from 0."""
    random = Random(f"{seed} {number}")
    fidelity, law, order = MODELS[number % len(MODELS)]
    parameters = _device(random) | {"fidelity": fidelity, "friction_law": law}
    if fidelity == 0:
        parameters["averaging_order"] = order
    if fidelity == 0 and order == 2:
        parameters |= _light_friction(random, parameters)
    if law == 1:
        parameters |= _bristles(random, parameters)
    return RandomCase(seed, number, parameters, _schedule(random, parameters))


def _decades(random: Random, low: float, high: float) -> float:
    return float(10.0 ** random.uniform(low, high))


def _device(random: Random) -> dict[str, float]:
    w, mass = _decades(random, 1.0, 5.0), _decades(random, -3.0, 2.0)
    values: dict[str, float] = {
        "drive_frequency": w,
        "slider_mass": mass,
        "resonator_mass": mass * _decades(random, -3.0, 0.5),
        "resonator_frequency": w * _decades(random, -0.7, 0.7),
        "damping_ratio": random.choice((0.05, _decades(random, -3.0, 0.3))),
        "base_amplitude": _decades(random, -7.0, -2.0),
        "friction_coefficient": _decades(random, -2.0, 1.0),
        "friction_faces": random.choice((1, 2)),
    }
    drive = values["resonator_mass"] * values["base_amplitude"] * w * w
    friction = drive * _decades(random, -3.0, 0.5)
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
    """Damping, friction and tolerance under which periods are leapt over."""
    parameters = {**values, "damping_ratio": _decades(random, log10(MIN_DAMPING), 0.0)}
    device = Device.from_mapping(parameters)
    share = _decades(random, *map(log10, FRICTION_SHARES))
    friction = abs(equivalent_force(device).amplitude) * share
    preload = friction / (device.friction_faces * device.friction_coefficient)
    varies = device.normal_amplitude / device.normal_preload
    return parameters | {
        "normal_preload": preload,
        "normal_amplitude": preload * varies,
        "tolerance": _decades(random, *map(log10, LEAP_TOLERANCES)),
    }


def _bristles(random: Random, values: Mapping[str, float]) -> dict[str, float]:
    """Bristles from soft to hard, as the fast motion sees them."""
    device = Device.from_mapping(values)
    fast = equivalent_force(device).velocity_amplitude
    mu, w = device.friction_coefficient, device.drive_frequency
    stiffness = mu * w / fast * _decades(random, -1.0, 3.0)
    return {
        "bristle_stiffness": stiffness,
        "bristle_damping": mu / fast * _decades(random, -3.0, -0.3),
        "initial_bristle_deflection": random.choice(
            (0.0, random.uniform(-1.0, 1.0) * mu / stiffness)
        ),
        "tolerance": _decades(random, -11.0, -6.0),
    }


def _schedule(random: Random, values: Mapping[str, float]) -> Schedule:
    device = Device.from_mapping(values)
    period = tau / device.drive_frequency
    second_order = device.fidelity == 0 and device.averaging_order == 2
    low, high = AVERAGED_PERIODS if device.fidelity == 0 else RESOLVED_PERIODS
    if second_order:
        low, high = SECOND_ORDER_PERIODS
    duration = period * _decades(random, log10(low), log10(high))
    if device.fidelity == 0 and device.friction_law == 1 and not second_order:
        fast = equivalent_force(device).velocity_amplitude
        duration = min(
            duration, MAX_LUGRE_RELAXATIONS * device.total_mass * fast / device.mean_friction
        )
    count = random.randint(1, 60)
    if second_order and random.random() < 0.5:
        count = random.randint(1, SECOND_ORDER_STEPS)
    inside = sorted(random.uniform(0.0, 1.0) for _ in range(count - 1))
    if random.random() < 0.5:  # equal steps, the last one a part of them
        inside = [i / (count - random.uniform(0.1, 1.0)) for i in range(1, count)]
    times = np.unique(duration * np.array([0.0, *(t for t in inside if t < 1.0), 1.0]))
    jumps = sorted({0, *(random.randrange(len(times)) for _ in range(random.randint(0, 4)))})
    starts = [float(times[i]) for i in jumps if i < len(times) - 1]
    load = device.mean_friction * random.choice((0.0, 0.3, 1.2))
    ratios: tuple[float, ...] = (*RATIOS, random.uniform(-3.0, 5.0))
    ratio = random.choice(ratios)

    def over(draw: list[float]) -> Signal:
        return Signal(tuple(starts), tuple(draw))

    tuning: dict[str, Signal] = {}
    if len(starts) > 1 and random.random() < 0.5:
        for name in random.sample((*TUNABLES, "drive_frequency"), random.randint(1, 6)):
            width = 0.04 if name == "drive_frequency" else 0.3
            first = float(getattr(device, name))
            later = [first * _decades(random, -width, width) for _ in starts[1:]]
            tuning[name] = over([first, *later])
    return Schedule(
        times,
        over([random.uniform(-10.0, 10.0) for _ in starts]),
        over([load * random.uniform(-1.0, 1.0) for _ in starts]),
        over([ratio if random.random() < 0.7 else random.choice(ratios) for _ in starts]),
        tuning=tuning,
        start_time=random.choice(START_TIMES),
    )
