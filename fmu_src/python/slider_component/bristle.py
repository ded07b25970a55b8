"""The bristle of LuGre friction as a function of the path (eq. 8)."""

from __future__ import annotations

from dataclasses import dataclass
from math import expm1

from . import refusal_texts
from .device import Device
from .refusal import Refusal


@dataclass(frozen=True, slots=True)
class Bristle:
    """Coefficient mu > 0 [1], stiffness sigma_0 [1/m] and damping sigma_1 [s/m]."""

    coefficient: float
    stiffness: float
    damping: float

    def after(self, friction: float, travel: float) -> float:
        """sigma_0 z after `travel` [m] in one direction (its sign), from `friction` on."""
        limit = self.coefficient if travel >= 0.0 else -self.coefficient
        return friction - (limit - friction) * expm1(
            -self.stiffness * abs(travel) / self.coefficient
        )


def bristle_of(device: Device) -> Bristle:
    """The bristle of a device. Raises Refusal without friction, where (8) has no meaning."""
    if device.friction_coefficient == 0.0:
        raise Refusal(refusal_texts.lugre_without_friction(device.friction_coefficient))
    return Bristle(device.friction_coefficient, device.bristle_stiffness, device.bristle_damping)
