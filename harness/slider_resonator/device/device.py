"""The device parameters of the contract: SI units, and table 1 of the paper as start values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any


def _parameter(start: float, unit: str) -> Any:
    return field(default=start, metadata={"unit": unit})


@dataclass(frozen=True)
class Device:
    """Parameters of the slider with an embedded resonator, SI units, start values of table 1.

    Names are those of the FMU parameters. ``friction_law`` is 0 (Coulomb) or 1 (LuGre),
    ``fidelity`` the number of resolved degrees of freedom (0 averaged, 1, 2).
    """

    slider_mass: float = _parameter(1.0, "kg")
    resonator_mass: float = _parameter(0.1, "kg")
    resonator_frequency: float = _parameter(3500.0, "rad/s")
    damping_ratio: float = _parameter(0.05, "1")
    normal_preload: float = _parameter(1.0, "N")
    normal_amplitude: float = _parameter(1.0, "N")
    base_amplitude: float = _parameter(1e-4, "m")
    drive_frequency: float = _parameter(3500.0, "rad/s")
    tangential_force: float = _parameter(0.0, "N")
    friction_coefficient: float = _parameter(0.1, "1")
    friction_faces: int = _parameter(2, "1")
    friction_law: int = _parameter(0, "1")
    bristle_stiffness: float = _parameter(1e5, "1/m")
    bristle_damping: float = _parameter(10.0, "s/m")
    fidelity: int = _parameter(2, "1")
    tolerance: float = _parameter(1e-8, "1")
    initial_position: float = _parameter(0.0, "m")
    initial_velocity: float = _parameter(0.0, "m/s")
    initial_resonator_displacement: float = _parameter(0.0, "m")
    initial_resonator_velocity: float = _parameter(0.0, "m/s")
    initial_bristle_deflection: float = _parameter(0.0, "m")

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
                    f"must be one of {', '.join(sorted(known))}"
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
