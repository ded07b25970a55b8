"""Parameters of the device, by the names of the interface."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Device:
    """All parameters (SI units). The defaults are the starts of the interface: table 1."""

    slider_mass: float = 1.0
    resonator_mass: float = 0.1
    resonator_frequency: float = 3500.0
    damping_ratio: float = 0.05
    normal_preload: float = 1.0
    normal_amplitude: float = 1.0
    base_amplitude: float = 1e-4
    drive_frequency: float = 3500.0
    tangential_force: float = 0.0
    friction_coefficient: float = 0.1
    friction_faces: int = 2
    friction_law: int = 0
    bristle_stiffness: float = 1e5
    bristle_damping: float = 10.0
    fidelity: int = 2
    tolerance: float = 1e-8
    initial_position: float = 0.0
    initial_velocity: float = 0.0
    initial_resonator_displacement: float = 0.0
    initial_resonator_velocity: float = 0.0
    initial_bristle_deflection: float = 0.0

    @property
    def total_mass(self) -> float:
        """Mass of slider and resonator [kg]."""
        return self.slider_mass + self.resonator_mass

    @property
    def mass_fraction(self) -> float:
        """Share of the resonator in the total mass, r_m (below eq. 29)."""
        return self.resonator_mass / self.total_mass


@dataclass(frozen=True, slots=True)
class Inputs:
    """The inputs of the interface (rad, N, 1)."""

    phase: float = 0.0
    load: float = 0.0
    frequency_ratio: float = 1.0
