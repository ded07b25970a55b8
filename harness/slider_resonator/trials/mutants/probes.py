"""Random scenes that show whether a mutant changes any result at all.

A probe is a scene file like any other, but what it expects is what the original FMU gives: devices,
inputs and communication steps of all kinds, drawn so that sliding, sticking, flight and every model
occur.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import pi, sqrt
from pathlib import Path
from random import Random

from slider_resonator.device.device import Device

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


@dataclass(frozen=True)
class Expectation:
    """A quantity and by how much it may change, in a share of it and in its unit."""

    quantity: str
    relative: float = 0.0
    absolute: float = 0.0

    def toml(self) -> str:
        """Return the entry of a scene file; the reference in it is never asked."""
        asked = {"quantity": self.quantity, "reference": "located_events"}
        if self.quantity.endswith("_status"):
            asked = {"quantity": self.quantity, "value": "steady"}
        elif self.quantity.startswith("predicted_"):
            asked["reference"] = "averaged"
        lines = [f'{key} = "{value}"' for key, value in asked.items()]
        if self.relative or self.absolute:
            lines.append(f"relative = {self.relative!r}")
        if self.absolute:
            lines.append(f"absolute = {self.absolute!r}")
        return "\n".join(["[[expect]]", *lines, 'why = "as the original"'])


def write_probes(folder: Path, count: int, seed: int) -> list[Path]:
    """Write `count` scene files, the same ones for the same seed, and return their paths."""
    paths = []
    for index in range(count):
        path = folder / f"probe_{index}.toml"
        path.write_text(_probe(index, Random(f"{seed} {index}")), encoding="utf-8")
        paths.append(path)
    return paths


def allowed_share(device: Device) -> float:
    """Return by which share of its peak a signal of such a device may change."""
    return _near(device.fidelity, device.friction_law)


def _near(fidelity: int, law: int) -> float:
    return COULOMB_ALLOWED if fidelity > 0 and law == 0 else ALLOWED


def _probe(index: int, draw: Random) -> str:
    fidelity, law = MODELS[index % len(MODELS)]
    device = _device(draw, fidelity, law)
    steady = index % 2 == 0 and fidelity > 0 and law == 0
    inputs = _inputs(draw, device, changing=not steady)
    periods = draw.choice((6, 9, 12))
    if fidelity == 0:  # slow motion takes its time, and a bristle's mean friction much of ours
        periods *= 3 if law else 10
    stepping = draw.choice((5.0, 11.0, 16.0)) if fidelity else draw.choice((0.3, 0.9, 4.0))
    parts = [
        f'name = "probe_{index}"\ntitle = "Probe {index}"',
        "[device]",
        *(f"{name} = {value!r}" for name, value in device.items()),
        "[inputs]",
        *inputs,
        "[run]",
        f"drive_periods = {periods}\nsteps_per_period = {stepping!r}",
        *(e.toml() for e in _expectations(fidelity, law, steady=steady)),
    ]
    return "\n".join(parts) + "\n"


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


def _inputs(draw: Random, device: Mapping[str, float], *, changing: bool) -> Iterator[str]:
    friction = device["friction_faces"] * device["friction_coefficient"] * device["normal_preload"]
    period = 2.0 * pi / device["drive_frequency"]
    ratios = (1.0, 1.0, 2.0, 3.0, -1.0, 0.0, 0.5, 0.01, 1.03, draw.uniform(0.2, 4.0))
    values = {
        "phase": [draw.uniform(-3.0, 3.0) for _ in range(2)],
        "load": [draw.choice((0.0, draw.uniform(-1.2, 1.2))) * friction for _ in range(2)],
        "frequency_ratio": [draw.choice(ratios) for _ in range(2)],
    }
    for name, (first, second) in values.items():
        if changing and draw.random() < 0.6:
            at = draw.uniform(1.0, 5.0) * period
            yield f"{name} = {{ steps = [[0.0, {first!r}], [{at!r}, {second!r}]] }}"
        elif changing or name != "frequency_ratio":
            yield f"{name} = {first!r}"
        else:  # a common period, which steady motion needs
            yield f"{name} = {draw.choice((1.0, 1.0, 2.0, 3.0, 0.5, 1.5))!r}"


def _expectations(fidelity: int, law: int, *, steady: bool) -> Iterator[Expectation]:
    near = _near(fidelity, law)
    for name in _SIGNALS:
        wider = 10.0 if name == "friction_force" and law == 1 else 1.0
        yield Expectation(name, wider * near)
    yield Expectation("contact_mode")
    if steady:
        yield Expectation("steady_velocity", 1e-6, 1e-8)
        yield Expectation("steady_status")
        yield Expectation("blocking_force", 1e-5, 1e-8)
        yield Expectation("predicted_velocity", 1e-8, 1e-10)
        yield Expectation("predicted_blocking_force", 1e-8, 1e-10)


def _log(draw: Random, low: float, high: float) -> float:
    return float(low * (high / low) ** draw.random())
