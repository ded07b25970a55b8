"""A device under held inputs: all that depends on parameters and inputs alone."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from .bristle import Bristle, bristle_of
from .contact import LIFTED, direction_of, flight_window, is_lifted
from .device import Device, Inputs
from .plant import Plant, plant
from .split_slide import Split, split

LONGEST_ARC = 60.0
"""The longest leg, as an angle [rad] of the fastest oscillation: avoids the rounding errors of
large arguments of sine and cosine."""
MAX_KEPT = 4
"""Largest number of devices under other phases and loads that are kept: the search for an orbit
asks for the same few again and again."""


@dataclass(frozen=True, slots=True)
class Held:
    """A device under held inputs, prepared for motion.

    Sliding and flight use `split` unless it is None; `arc` [s] is the longest leg, after which a
    motion begins anew from its state.
    """

    device: Device
    inputs: Inputs
    plant: Plant
    split: Split | None
    window: tuple[float, float] | None
    arc: float
    bristle: Bristle
    kept: list[Held] = field(default_factory=list, compare=False, repr=False)

    def lifted_at(self, psi: float) -> bool:
        """Whether the contact is lifted at normal phase `psi` [rad]."""
        return is_lifted(self.window, psi + self.plant.phase, self.plant.normal_frequency)

    def mode_by_velocity(self, velocity: float, psi: float) -> int:
        """Contact mode by load and velocity alone: lifted, or direction of sliding; 0 at rest."""
        return LIFTED if self.lifted_at(psi) else direction_of(velocity)

    def under(self, phase: float, load: float) -> Held:
        """The same under another phase [rad] and load [N]; nothing prepared depends on these."""
        for held in self.kept:
            if held.plant.phase == phase and held.plant.load == load:
                return held
        plant = replace(self.plant, phase=phase, load=load)
        split = self.split and replace(self.split, plant=plant)
        inputs = replace(self.inputs, phase=phase, load=load)
        held = replace(self, inputs=inputs, plant=plant, split=split, kept=[])
        self.kept.append(held)
        del self.kept[:-MAX_KEPT]
        return held


def hold(device: Device, inputs: Inputs) -> Held:
    """Prepare motion of `device` under `inputs`. Raises Refusal as `plant` does."""
    held = plant(device, inputs)
    fastest = max(held.drive_frequency, abs(held.normal_frequency))
    if held.resolves_resonator:
        fastest = max(
            [fastest] + [o.frequency for o in (held.slip, held.stick) if o.eigenvalue is not None]
        )
    return Held(
        device,
        inputs,
        held,
        split(held),
        flight_window(held),
        LONGEST_ARC / fastest,
        bristle_of(device),
    )
