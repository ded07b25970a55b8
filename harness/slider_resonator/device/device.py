"""The device parameters of the contract, with table 1 of the paper as start values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any


@dataclass(frozen=True)
class Device:
    """Parameters of the slider with an embedded resonator, SI units, start values of table 1.

    Names are those of the FMU parameters. ``friction_law`` is 0 (Coulomb) or 1 (LuGre),
    ``fidelity`` the number of resolved degrees of freedom (0 averaged, 1, 2).
    """

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

    @classmethod
    def from_mapping(cls, values: Mapping[str, float]) -> Device:
        """Return table 1 with the given parameters replaced.

        Raises ValueError naming an unknown parameter, or an Integer parameter that got a fraction.
        """
        integer_names = {field.name for field in fields(cls) if field.type == "int"}
        known = {field.name for field in fields(cls)}
        arguments: dict[str, Any] = {}
        for name, value in values.items():
            if name not in known:
                raise ValueError(
                    f"unknown device parameter {name!r} = {value!r}; "
                    f"allowed: {', '.join(sorted(known))}"
                )
            if name in integer_names:
                if not float(value).is_integer():
                    raise ValueError(f"device parameter {name} = {value!r} must be an integer")
                arguments[name] = int(value)
            else:
                arguments[name] = float(value)
        return cls(**arguments)

    @property
    def total_mass(self) -> float:
        """Mass of slider and resonator together, kg."""
        return self.slider_mass + self.resonator_mass

    @property
    def mass_ratio(self) -> float:
        """Resonator mass over total mass, r_m below (29)."""
        return self.resonator_mass / self.total_mass

    @property
    def mean_friction(self) -> float:
        """Friction of all faces at the mean normal load of a closed contact, faces mu N0, N."""
        return self.friction_faces * self.friction_coefficient * self.normal_preload

    @property
    def amplitude_ratio(self) -> float:
        """Amplitude over mean of the normal load, alpha below (2)."""
        return self.normal_amplitude / self.normal_preload

    @property
    def stiffness(self) -> float:
        """Resonator stiffness k, N/m."""
        return self.resonator_mass * self.resonator_frequency**2

    @property
    def damping(self) -> float:
        """Resonator damping c, N s/m."""
        return 2.0 * self.damping_ratio * self.resonator_mass * self.resonator_frequency
