"""The device: its parameters, and the masses that follow from them."""

from __future__ import annotations

from dataclasses import dataclass

from .parameters import Inputs, Parameters

__all__ = ["Device", "Inputs"]


@dataclass(frozen=True, slots=True)
class Device(Parameters):
    """All parameters (SI units); the defaults are the start values: table 1."""

    @property
    def total_mass(self) -> float:
        """Mass of slider and resonator [kg]."""
        return self.slider_mass + self.resonator_mass

    @property
    def mass_fraction(self) -> float:
        """Resonator mass over total mass, r_m (below eq. 29)."""
        return self.resonator_mass / self.total_mass
