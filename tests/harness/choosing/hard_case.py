"""A hard scene in the making, and devices for it."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi
from typing import Any

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.references.closed_forms import equivalent_force
from tests.harness.choosing.generated_scenes import Draw

COSTLY = 8.0
"""Cost of a drive period with LuGre friction, relative to Coulomb friction."""


@dataclass
class Case:
    """A scene in the making: device, inputs, tuning, drive periods, needs; what is passed on."""

    draw: Draw
    device: dict[str, float]
    periods: float = 0.0
    inputs: dict[str, Any] = field(default_factory=dict)
    needs: dict[str, Any] = field(default_factory=dict)
    tuning: dict[str, Any] = field(default_factory=dict)
    interpolates: bool = False

    @property
    def period(self) -> float:
        """Drive period in s."""
        return 2.0 * pi / self.device["drive_frequency"]

    @property
    def duration(self) -> float:
        """Length of the run in s."""
        return self.periods * self.period

    @property
    def friction(self) -> float:
        """Mean friction in N."""
        return Device.from_mapping(self.device).mean_friction

    def run(self, low: float, high: float) -> None:
        """Run for some drive periods; fewer with LuGre friction, which is expensive to judge."""
        most = high / COSTLY if self.device["friction_law"] else high
        self.periods = self.draw.log(low, max(most, 1.5 * low))

    def jumps(self, name: str, shares: list[float], size: float) -> None:
        """Let an input jump at shares of the run by about `size`, in its own scale."""
        scale = {"load": self.friction, "phase": 1.0, "frequency_ratio": 1.0}[name]
        first = {"load": 0.0, "phase": self.draw.uniform(-pi, pi), "frequency_ratio": 1.0}[name]
        values = [first] + [first + scale * size * self.draw.uniform(-1.0, 1.0) for _ in shares]
        times = [0.0, *sorted(share * self.duration for share in shares)]
        self.inputs[name] = {"steps": list(zip(times, values, strict=True))}

    def need(self, *names: str, loosest: float = 0.3, tightest: float = 1e-4) -> None:
        """Need each quantity, as a share of it or of the fast velocity."""
        fast = equivalent_force(Device.from_mapping(self.device)).velocity_amplitude
        for name in names:
            share = self.draw.log(tightest, loosest)
            absolute = name in ("velocity", "mean_velocity") and self.draw.chance(0.4)
            self.needs[name] = {"abs": share * fast} if absolute else {"rel": share}

    def need_some(self, tightest: float = 1e-4) -> None:
        """Need one or two quantities of a run."""
        names = ("mean_velocity", "mean_velocity", "position", "position", "velocity")
        for _ in range(2 if self.draw.chance(0.3) else 1):
            self.need(names[int(self.draw.rng.integers(len(names)))], tightest=tightest)


def strong(case: Case) -> None:
    """Drive the device until it slides nearly all the time, with a resonator that forgets soon."""
    drive(case, case.draw.log(30.0, 3000.0))
    case.device["damping_ratio"] = case.draw.log(0.03, 0.3)


def drive(case: Case, strength: float) -> None:
    """Set the amplitude of the base so that the driving force is so many times the friction."""
    force = equivalent_force(Device.from_mapping(case.device))
    before = force.velocity_amplitude
    case.device["base_amplitude"] *= strength * case.friction / force.amplitude
    after = equivalent_force(Device.from_mapping(case.device)).velocity_amplitude
    if case.device["friction_law"]:
        case.device["bristle_stiffness"] *= before / after
        case.device["bristle_damping"] *= before / after


def lugre(case: Case, kappa: float) -> None:
    """Make the friction LuGre's, with the path of the vibration so many times the bristle's."""
    device = case.device
    fast = equivalent_force(Device.from_mapping(device)).velocity_amplitude
    device["friction_law"] = 1
    path = device["friction_coefficient"] * device["drive_frequency"] / fast
    device["bristle_stiffness"] = kappa * path
    damping = case.draw.log(1e-2, 1.0) * device["friction_coefficient"] / fast
    device["bristle_damping"] = damping


def constant(case: Case) -> None:
    draw, device = case.draw, Device.from_mapping(case.device)
    phase = draw.uniform(-pi, pi)
    angle = equivalent_force(device).angle
    blocking = 2.0 / pi * device.friction_faces * device.friction_coefficient
    blocking *= device.normal_amplitude * float(np.sin(phase + angle))
    case.inputs = {"phase": phase, "load": draw.uniform(-1.0, 1.0) * blocking}
    if draw.chance(0.2):
        case.inputs["frequency_ratio"] = draw.one_of(2.0, 3.0, 0.5)
