"""Scenes at random: devices that averaging suits and others, inputs and needs of every kind."""

from math import ceil, pi
from typing import Any

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.scenes.scene import Scene, scene_from

COUNT = 200
STEADY_SHARE = 0.2
LONGEST = {0: 50_000.0, 1: 8000.0}
"""Drive periods of the longest run, by friction law."""
MAX_CHECKPOINTS = 3000
"""Communication points of a scene in its own step."""

Rng = np.random.Generator


def log(rng: Rng, low: float, high: float) -> float:
    """Return a number between two others, uniform in its logarithm."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def one_of(rng: Rng, *values: float) -> float:
    return values[int(rng.integers(len(values)))]


def generated_scene(seed: int) -> Scene:
    """Return the scene of a seed."""
    rng = np.random.default_rng([20261121, seed])
    device = random_device(rng)
    steady = rng.uniform() < STEADY_SHARE
    law = int(device["friction_law"])
    periods = log(rng, 30.0, LONGEST[law])
    duration = periods * 2.0 * pi / device["drive_frequency"]
    inputs = _inputs(rng, Device.from_mapping(device), duration, steady)
    content: dict[str, Any] = {"device": device, "inputs": inputs}
    if not steady:
        per_period = min(one_of(rng, 1.0, 4.0, 16.0), MAX_CHECKPOINTS / periods)
        content["run"] = {"stop_time": duration, "steps_per_period": per_period}
    ramps = any(isinstance(given, dict) and "ramp" in given for given in inputs.values())
    fast = equivalent_force(Device.from_mapping(device)).velocity_amplitude
    need = _needs(rng, inputs, steady, 1e-4 if ramps else 1e-5, fast)
    if law == 1 and rng.uniform() < 0.5:
        need["friction_law"] = "free"
    name = f"scene_{seed}"
    return scene_from({"name": name, "title": name, **content, "need": need}, name)


def random_device(rng: Rng) -> dict[str, float]:
    """Return a device whose drive is 0.5 to 100 000 times its friction."""
    slider, share = log(rng, 0.1, 10.0), log(rng, 0.005, 0.5)
    frequency = log(rng, 100.0, 35_000.0)
    preload = log(rng, 0.1, 30.0)
    lift = rng.uniform() < 0.1
    coefficient, faces = log(rng, 0.02, 1.0), one_of(rng, 1, 2)
    device = {
        "slider_mass": slider,
        "resonator_mass": slider * share / (1.0 - share),
        "drive_frequency": frequency,
        "resonator_frequency": frequency * (1.0 if rng.uniform() < 0.6 else log(rng, 0.5, 2.0)),
        "damping_ratio": log(rng, 1e-3, 0.3),
        "normal_preload": preload,
        "normal_amplitude": preload * (rng.uniform(1.0, 2.0) if lift else rng.uniform(0.0, 1.0)),
        "friction_coefficient": coefficient,
        "friction_faces": int(faces),
        "base_amplitude": 1e-4,
        "friction_law": int(rng.uniform() < 0.45),
    }
    force = equivalent_force(Device.from_mapping(device))
    strength = log(rng, 30.0, 1e5) if rng.uniform() < 0.7 else log(rng, 0.5, 30.0)
    drive = strength * faces * coefficient * preload
    device["base_amplitude"] *= drive / force.amplitude
    fast = force.velocity_amplitude * drive / force.amplitude
    if device["friction_law"]:
        kappa = log(rng, 1e-2, 1e4)
        device["bristle_stiffness"] = kappa * coefficient * frequency / fast
        device["bristle_damping"] = log(rng, 1e-2, 1.0) * coefficient / fast
    return device


def _inputs(rng: Rng, device: Device, duration: float, steady: bool) -> dict[str, Any]:
    sliding = device.friction_faces * device.friction_coefficient
    friction = sliding * device.normal_preload
    phase = rng.uniform(-pi, pi)
    turned = np.sin(phase + equivalent_force(device).angle)
    blocking = 2.0 / pi * sliding * device.normal_amplitude * turned
    limits = ((0.0, 0.0, 0.0), (blocking, 0.9, 1.1), (blocking, -1.0, 1.0), (friction, -0.7, 0.7))
    force, low, high = limits[int(one_of(rng, 0, 0, 1, 2, 3))]
    load = float(force * rng.uniform(low, high)) if force else 0.0
    inputs: dict[str, Any] = {"phase": phase, "load": load}
    ratio = one_of(rng, 0, 0, 0, 0, 1, 2, 3)
    if ratio == 1:
        inputs["frequency_ratio"] = one_of(rng, 2.0, 3.0, 5.0, 1.5, 0.0)
    elif ratio == 2 and not steady:
        inputs["frequency_ratio"] = 1.0 + one_of(rng, -1, 1) * log(rng, 1e-4, 0.05)
    elif ratio == 3 and not steady:
        inputs["frequency_ratio"] = rng.uniform(0.2, 3.0)
    if steady or rng.uniform() < 0.5:
        return inputs
    times = np.sort([rng.uniform(0.0, duration) for _ in range(ceil(rng.uniform(0.0, 3.0)))])
    way = "steps" if rng.uniform() < 0.5 else "ramp"
    loads = [load] + [float(load + friction * rng.uniform(-0.5, 0.5)) for _ in times]
    phases = [phase] + [phase + rng.uniform(-1.0, 1.0) for _ in times]
    for name, values in (("load", loads), ("phase", phases)):
        if rng.uniform() < 0.6:
            inputs[name] = {way: list(zip([0.0, *times.tolist()], values, strict=True))}
    if way == "ramp" and rng.uniform() < 0.2:
        start, end = rng.uniform(0.9, 1.1), rng.uniform(0.9, 1.1)
        inputs["frequency_ratio"] = {"ramp": [(0.0, start), (duration, end)]}
    return inputs


def _needs(
    rng: Rng, inputs: dict[str, Any], steady: bool, tightest: float, fast: float
) -> dict[str, Any]:
    ratio = inputs.get("frequency_ratio", 1.0)
    beats = isinstance(ratio, float) and 0.0 < abs(ratio - 1.0) < 0.1
    names = ["mean_velocity"] * 4 + ["position"] * 2 + ["velocity", "event_times"]
    names += ["beat"] * 3 * beats
    if steady:
        names = ["steady_velocity", "blocking_force"]
    chosen = {names[int(rng.integers(len(names)))] for _ in range(ceil(rng.uniform(0, 1.5)))}
    needs: dict[str, Any] = {}
    for name in sorted(chosen):
        share = log(rng, tightest, 0.5) * {"event_times": 1e-2, "beat": 1e-1}.get(name, 1.0)
        absolute = name.endswith("velocity") and rng.uniform() < 0.5
        needs[name] = {"abs": share * fast} if absolute else {"rel": share}
    return needs
