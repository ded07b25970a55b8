"""Random scenes that show whether a mutant changes any result at all.

A probe is a scene like any other, but expects what the original FMU gives: devices, inputs and
communication steps of all kinds, drawn so that sliding, sticking, flight and every model occur.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi, sqrt
from random import Random
from typing import Any

from slider_resonator.scenes.scene import Scene, scene_from

COULOMB_ALLOWED = 1e-8
ALLOWED = 1e-6
"""Share of a signal's peak that the built-in scenes allow: resolved Coulomb friction, all else."""

MODELS = (
    *((2, 0), (2, 0), (1, 0), (0, 0), (2, 1), (0, 1)),
    *((2, 0), (2, 0), (1, 0), (0, 0), (2, 1), (1, 1), (0, 1)),
)
"""Fidelity and friction law of one probe after the other, over and over."""

_SIGNALS = (
    "position",
    "velocity",
    "resonator_displacement",
    "resonator_velocity",
    "normal_force",
    "friction_force",
)

_SPECIAL: tuple[Mapping[str, float], ...] = (
    {"base_amplitude": 0.0, "tangential_force": 0.0},
    {"normal_preload": 0.0},
    {"resonator_mass": 0.0},
)
"""Devices without a drive, a preload or a resonator mass."""


def probe_scenes(count: int, seed: int) -> list[Scene]:
    """Return `count` scenes, the same ones for the same seed."""
    names = (f"probe_{index}" for index in range(count))
    return [
        scene_from(_probe(name, index, Random(f"{seed} {index}")), name)
        for index, name in enumerate(names)
    ]


def allowed_share(fidelity: int, law: int) -> float:
    """Return the allowed change of a signal of such a device, as a share of its peak."""
    return COULOMB_ALLOWED if fidelity > 0 and law == 0 else ALLOWED


def _probe(name: str, index: int, draw: Random) -> dict[str, Any]:
    """Return the content of a scene file."""
    fidelity, law = MODELS[index % len(MODELS)]
    device = _device(draw, fidelity, law)
    steady = index % 2 == 0 and fidelity > 0 and law == 0
    periods = draw.choice((6, 9, 12))
    if fidelity == 0:  # slow motion takes its time, and a bristle's mean friction much of ours
        periods *= 3 if law else 10
    stepping = draw.choice((5.0, 11.0, 16.0)) if fidelity else draw.choice((0.3, 0.9, 4.0))
    return {
        "name": name,
        "title": f"Probe {index}",
        "device": device,
        "inputs": _inputs(draw, device, changing=not steady),
        "run": {"drive_periods": periods, "steps_per_period": stepping},
        "expect": _expectations(fidelity, law, steady=steady),
    }


def _device(draw: Random, fidelity: int, law: int) -> dict[str, float]:
    slider, resonator = _log(draw, 0.3, 3.0), _log(draw, 0.02, 1.0)
    drive = _log(draw, 500.0, 10000.0)
    damping = draw.choice((_log(draw, 0.01, 0.3), _log(draw, 0.01, 0.3), 0.93, 1.0, 1.6))
    free = sqrt(slider / (slider + resonator))  # of the resonator on a free slider, over this one
    resonance = drive * draw.choice((1.0, free, _log(draw, 0.2, 3.0), _log(draw, 0.2, 3.0), 0.01))
    preload = draw.choice((1.0, _log(draw, 0.1, 10.0)))
    amplitude = preload * draw.choice((0.0, 0.5, 1.0, draw.uniform(0.1, 1.0), 1.7))
    # A bristle under flight costs seconds: a scene of its own has it.
    if fidelity == 0 and law == 1:
        amplitude = min(amplitude, preload)
    coefficient, faces = draw.uniform(0.03, 0.5), draw.choice((1, 2))
    force = faces * coefficient * preload * _log(draw, 0.3, 300.0)
    device = {
        "slider_mass": slider,
        "resonator_mass": resonator,
        "resonator_frequency": resonance,
        "damping_ratio": damping,
        "normal_preload": preload,
        "normal_amplitude": amplitude,
        "base_amplitude": force / (resonator * drive * drive),
        "drive_frequency": drive,
        "tangential_force": draw.choice((0.0, 0.3 * force)),
        "friction_coefficient": coefficient,
        "friction_faces": float(faces),
        "friction_law": float(law),
        "fidelity": float(fidelity),
        "initial_position": draw.choice((0.0, 1e-4)),
        "initial_velocity": draw.choice((0.0, 0.1, -1.0)) * force / ((slider + resonator) * drive),
    }
    if fidelity == 2 and draw.random() < 0.3:
        device |= {"damping_ratio": draw.choice((0.0, 1e-3))}
    if draw.random() < 0.1:
        device |= draw.choice(_SPECIAL)
    if draw.random() < 0.5:
        swing = force / ((slider + resonator) * drive)
        device |= {
            "initial_resonator_displacement": draw.uniform(-1.0, 1.0) * swing / drive,
            "initial_resonator_velocity": draw.uniform(-1.0, 1.0) * swing,
        }
    if law == 1:
        path = force / ((slider + resonator) * drive * drive)
        stiffness = coefficient / path * _log(draw, 0.03, 300.0)
        device |= {
            "bristle_stiffness": stiffness,
            "bristle_damping": draw.choice((0.0, 0.3)) * coefficient / (path * drive),
            "initial_bristle_deflection": draw.choice((0.0, 0.5)) * coefficient / stiffness,
            "tolerance": 1e-9,
        }
    return device


def _inputs(draw: Random, device: Mapping[str, float], *, changing: bool) -> dict[str, Any]:
    friction = device["friction_faces"] * device["friction_coefficient"] * device["normal_preload"]
    period = 2.0 * pi / device["drive_frequency"]
    ratios = (1.0, 1.0, 2.0, 3.0, -1.0, 0.0, 0.5, 0.01, 1.03, draw.uniform(0.2, 4.0))
    values = {
        "phase": [draw.uniform(-3.0, 3.0) for _ in range(2)],
        "load": [draw.choice((0.0, draw.uniform(-1.2, 1.2))) * friction for _ in range(2)],
        "frequency_ratio": [draw.choice(ratios) for _ in range(2)],
    }
    inputs: dict[str, Any] = {}
    for name, (first, second) in values.items():
        if changing and draw.random() < 0.6:
            at = draw.uniform(1.0, 5.0) * period
            inputs[name] = {"steps": [[0.0, first], [at, second]]}
        elif changing or name != "frequency_ratio":
            inputs[name] = first
        else:  # a common period, which steady motion needs
            inputs[name] = draw.choice((1.0, 1.0, 2.0, 3.0, 0.5, 1.5))
    return inputs


def _expectations(fidelity: int, law: int, *, steady: bool) -> list[dict[str, Any]]:
    share = allowed_share(fidelity, law)
    rough = 10.0 * share if law == 1 else share
    shares = {name: rough if name == "friction_force" else share for name in _SIGNALS}
    expect = [_expectation(name, relative) for name, relative in shares.items()]
    expect.append(_expectation("contact_mode"))
    if steady:
        expect += [
            _expectation("steady_velocity", 1e-6, 1e-8),
            _expectation("steady_status"),
            _expectation("blocking_force", 1e-5, 1e-8),
            _expectation("predicted_velocity", 1e-8, 1e-10),
            _expectation("predicted_blocking_force", 1e-8, 1e-10),
        ]
    return expect


def _expectation(quantity: str, relative: float = 0.0, absolute: float = 0.0) -> dict[str, Any]:
    """Return an expectation; the result of the original replaces its reference or value."""
    against = {"reference": "located_events"}
    if quantity.endswith("_status"):
        against = {"value": "steady"}
    elif quantity.startswith("predicted_"):
        against = {"reference": "averaged"}
    tolerance = {"relative": relative, "absolute": absolute}
    given = {name: size for name, size in tolerance.items() if size}
    return {"quantity": quantity, **against, **given, "why": "as the original"}


def _log(draw: Random, low: float, high: float) -> float:
    return float(low * (high / low) ** draw.random())
