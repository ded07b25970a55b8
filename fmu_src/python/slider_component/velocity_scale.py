"""The scale of velocities to which tolerances refer."""

from __future__ import annotations

from math import hypot

from .motion import State
from .plant import Plant


def velocity_scale(plant: Plant, state: State) -> float:
    """The scale of velocities [m/s] to which tolerances refer.

    The sum of the velocity amplitude of the drive, the velocity that friction and load change in a
    radian of the drive, and the velocities of slider and resonator.
    """
    w = plant.drive_frequency
    forces = plant.friction_preload + plant.friction_amplitude + abs(plant.load)
    swing = plant.mass_fraction * hypot(state.rate, plant.stick.frequency * state.displacement)
    return abs(plant.drive) / w + forces / (plant.total_mass * w) + abs(state.velocity) + swing
