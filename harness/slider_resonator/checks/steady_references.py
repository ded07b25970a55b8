"""The references for constant inputs: steady motion, predictions, the paper's closed forms."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import pi

from slider_resonator.device.device import FULL, Device
from slider_resonator.references.averaged.device_average import (
    blocking_force,
    prediction_valid,
    steady_velocity,
)
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.steady.reference_steady import (
    reference_blocking_force,
    reference_steady_velocity,
)


@dataclass(frozen=True)
class SteadyReferences:
    """Steady motion, predictions and closed forms for a device under constant inputs.

    `phase` in rad, `load` in N. Velocities are in m/s, forces in N, each computed on first use.
    """

    device: Device
    phase: float
    load: float
    frequency_ratio: float

    @cached_property
    def steady_velocity(self) -> float | None:
        """Mean velocity of the steady motion, by shooting with located events."""
        try:
            guess = self.predicted_velocity
        except ValueError:
            guess = 0.0
        inputs = (self.phase, self.load, self.frequency_ratio)
        return reference_steady_velocity(self.device, *inputs, guess)

    @cached_property
    def blocking_force(self) -> float | None:
        """Load that makes the mean velocity zero, by shooting with located events."""
        return reference_blocking_force(self.device, self.phase, self.frequency_ratio)

    @cached_property
    def full_device(self) -> "SteadyReferences":
        """The same for the full device, whatever the fidelity."""
        return replace(self, device=replace(self.device, fidelity=FULL))

    @property
    def predicted_velocity(self) -> float:
        """Steady velocity of averaged motion: any ratio, both laws, with lift-off."""
        return steady_velocity(self.device, self.phase, self.load, self.frequency_ratio)

    @property
    def predicted_blocking_force(self) -> float:
        """Blocking force of averaged motion, as for `predicted_velocity`."""
        return blocking_force(self.device, self.phase, self.frequency_ratio)

    @property
    def prediction_valid(self) -> float:
        """1 where averaged theory applies, 0 where not."""
        inputs = (self.phase, self.load, self.frequency_ratio)
        return 1.0 if prediction_valid(self.device, *inputs) else 0.0

    @property
    def averaged_velocity(self) -> float:
        """Steady velocity of the paper's theory, (5) and (20); for equal frequencies only."""
        return steady_velocity(self._device_of_paper(), self.phase, self.load, 1.0)

    @property
    def averaged_blocking_force(self) -> float:
        """Blocking force of the paper's theory, (22) for all faces; for equal frequencies only."""
        return blocking_force(self._device_of_paper(), self.phase, 1.0)

    @property
    def ripple_amplitude(self) -> float:
        """Amplitude (m) of the fast displacement, (33)-(34)."""
        return equivalent_force(self.device).ripple_amplitude

    @property
    def difference_frequency(self) -> float:
        """Distance (Hz) of the normal force's frequency from a multiple of the drive's: the beat.

        For a ratio near 1 it is that of appendix A.
        """
        ratio = self.frequency_ratio
        return abs(ratio - round(ratio)) * self.device.drive_frequency / (2.0 * pi)

    def _device_of_paper(self) -> Device:
        """Return the device with Coulomb friction; ValueError where (5) and (22) do not hold."""
        if self.frequency_ratio != 1.0:
            raise ValueError(
                f"frequency_ratio = {self.frequency_ratio!r}: the closed form allows only 1"
            )
        if self.device.normal_amplitude > self.device.normal_preload:
            raise ValueError(
                f"normal_amplitude = {self.device.normal_amplitude!r} N must be at most "
                f"normal_preload = {self.device.normal_preload!r} N: where the contact lifts the "
                "closed form does not hold"
            )
        return replace(self.device, friction_law=0)
