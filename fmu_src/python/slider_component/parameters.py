"""Parameters and inputs by the names of the interface (SI units).

Generated from fmu_src/python/slider_component/variables.py: edit that file instead.
Then run `python -m fmu_src.generate`.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Parameters:
    """All parameters; the defaults are the start values."""

    slider_mass: float = 1.0
    resonator_mass: float = 0.1
    resonator_frequency: float = 3500.0
    damping_ratio: float = 0.05
    normal_preload: float = 1.0
    normal_amplitude: float = 1.0
    base_amplitude: float = 0.0001
    drive_frequency: float = 3500.0
    tangential_force: float = 0.0
    friction_coefficient: float = 0.1
    friction_faces: int = 2
    friction_law: int = 0
    bristle_stiffness: float = 100000.0
    bristle_damping: float = 10.0
    fidelity: int = 2
    averaging_order: int = 2
    tolerance: float = 1e-08
    initial_position: float = 0.0
    initial_velocity: float = 0.0
    initial_resonator_displacement: float = 0.0
    initial_resonator_velocity: float = 0.0
    initial_bristle_deflection: float = 0.0


@dataclass(frozen=True, slots=True)
class Inputs:
    """All inputs; the defaults are the start values. `phase` is kept in [-pi, pi]."""

    phase: float = 0.0
    load: float = 0.0
    frequency_ratio: float = 1.0
    amplitude_deviation: float = 0.0
    frequency_deviation: float = 0.0
