"""The given data of a held orbit: mean velocity, normal load, and the vibration without friction.

The drive angle theta = w t is the independent variable of these modules; results are in SI units.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.references.averaged.panels import Oscillator, Panels
from slider_resonator.references.averaged.vibrating_contact import closed_spans
from slider_resonator.references.closed_forms import EquivalentForce, equivalent_force

_WIDEST_PANEL = 0.8
"""Width of a panel in rad of the fastest oscillation, which its nodes then resolve to rounding."""


@dataclass(frozen=True)
class Hold:
    """A mean velocity in m/s that is held, and the normal load that belongs to the drive.

    The load is ``max(0, N0 + dN sin(ratio theta + lead))``; ``ratio`` times ``turns`` is an
    integer: the motion repeats after that many turns of the drive. Raises ValueError for another
    ratio, without damping, and as `equivalent_force` does.
    """

    device: Device
    velocity: float
    lead: float = 0.0
    ratio: float = 1.0
    turns: int = 1
    vibration: EquivalentForce = field(init=False, repr=False)

    def __post_init__(self) -> None:
        waves = self.ratio * self.turns
        if self.turns < 1 or abs(waves - round(waves)) > 1e-9:
            raise ValueError(
                f"ratio = {self.ratio!r} times turns = {self.turns!r} must be an integer"
            )
        if not self.device.damping_ratio > 0.0:
            raise ValueError(
                f"damping_ratio = {self.device.damping_ratio!r} must be greater than 0: the "
                "resonator would never forget its start"
            )
        object.__setattr__(self, "vibration", equivalent_force(self.device))

    @property
    def period(self) -> float:
        """Angle of the drive in rad after which the motion repeats."""
        return 2.0 * math.pi * self.turns

    @property
    def resonator(self) -> Oscillator:
        """The resonator on a slider that is free to move, driven in m."""
        device = self.device
        tuning = device.resonator_frequency / device.drive_frequency
        return Oscillator(1.0 - device.mass_ratio, 2.0 * device.damping_ratio * tuning, tuning**2)

    @property
    def momentum_rate(self) -> float:
        """Total mass times drive frequency, kg/s: force over it is velocity per rad."""
        return self.device.total_mass * self.device.drive_frequency

    def friction_limit(self, theta: Array) -> Array:
        """Return ``faces mu N`` in N."""
        device = self.device
        angle = self.ratio * theta + self.lead
        normal = device.normal_preload + device.normal_amplitude * np.sin(angle)
        scale = device.friction_faces * device.friction_coefficient
        return np.asarray(scale * np.maximum(0.0, normal))

    def forced_velocity(self, theta: Array) -> Array:
        """Return the velocity in m/s of the slider that vibrates without friction, (33)."""
        force = self.vibration
        return np.asarray(-force.velocity_amplitude * np.cos(theta - force.angle))

    def forced_resonator(self, theta: Array) -> tuple[Array, Array]:
        """Return displacement in m and velocity in m/s of the resonator without friction, (32)."""
        force, angle = self.vibration, theta - self.vibration.resonator_angle
        speed = force.resonator_amplitude * self.device.drive_frequency
        return np.asarray(force.resonator_amplitude * np.sin(angle)), np.asarray(
            speed * np.cos(angle)
        )

    def contact_edges(self) -> list[float]:
        """Return the angles in [0, period] at which the contact opens or closes."""
        device = self.device
        amplitude_ratio = device.normal_amplitude / device.normal_preload
        spans = closed_spans(0.0, self.period, amplitude_ratio, self.lead, self.ratio)
        edges = {edge for span in spans for edge in span} - {0.0, self.period}
        return sorted(edges)

    def panels(self, breaks: Array, start: float, finest: float = math.inf) -> Panels:
        """Return panels over a period from ``start`` that end at all ``breaks``, within the period.

        After each break and before the next they grow from the width ``finest`` in rad by doubling.
        """
        fastest = max(1.0, abs(self.ratio), math.sqrt(self.resonator.stiffness))
        widest = _WIDEST_PANEL / fastest
        stops = np.unique(start + (np.asarray(breaks) - start) % self.period)
        stops = np.concatenate([[start], stops[stops > start], [start + self.period]])
        edges = [np.array([start])]
        for left, right in pairwise(stops.tolist()):
            edges.append(left + _graded(right - left, finest, widest))
        return Panels(np.concatenate(edges))


def _graded(length: float, finest: float, widest: float) -> Array:
    """Return where panels end on a length that starts at 0; the last of them is the length."""
    edges = []
    width, reached = min(finest, widest), 0.0
    while width < widest and reached + 2.0 * width < length:
        reached += width
        edges.append(reached)
        width *= 2.0
    count = math.ceil((length - reached) / widest)
    return np.concatenate([edges, np.linspace(reached, length, count + 1)[1:]])
