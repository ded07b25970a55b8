"""Inputs over an interval: held, or straight lines, as an FMU has them in a communication step."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Self

from slider_resonator.arrays import Number
from slider_resonator.device.device import Device


@dataclass(frozen=True)
class HeldInputs:
    """Inputs over ``[start, stop]`` (s): phase (rad), load (N), frequency_ratio (1).

    They are the values at ``start``, which stay, or change at constant rates per second. ``tuned``
    is what a run tunes, by name: parameters, deviations of the drive.
    """

    start: float
    stop: float
    phase: float = 0.0
    load: float = 0.0
    frequency_ratio: float = 1.0
    phase_rate: float = 0.0
    load_rate: float = 0.0
    ratio_rate: float = 0.0
    tuned: tuple[tuple[str, float], ...] = field(default=(), kw_only=True)

    @property
    def vary(self) -> bool:
        """Whether an input changes within the interval."""
        return any((self.phase_rate, self.load_rate, self.ratio_rate))

    def later(self, elapsed: float) -> Self:
        """Return the same inputs from ``elapsed`` (s) after the start on."""
        return replace(
            self,
            start=self.start + elapsed,
            phase=self.phase + self.phase_rate * elapsed,
            load=self.load + self.load_rate * elapsed,
            frequency_ratio=self.frequency_ratio + self.ratio_rate * elapsed,
        )

    def turned(self, duration: Number, frequency: float) -> Number:
        """Return the angle (rad) by which psi grows in ``duration`` (s) at a drive frequency."""
        ratio = self.frequency_ratio + 0.5 * self.ratio_rate * duration
        return ratio * frequency * duration


def with_steady_phase(held: Sequence[HeldInputs], device: Device) -> list[HeldInputs]:
    """Return inputs of the same normal load over time, none of whose phases has a rate.

    A ramp of the phase is a constant shift of the normal frequency: psi takes over what it adds.
    """
    steady: list[HeldInputs] = []
    gained = 0.0
    for inputs in held:
        frequency = device.tuned(inputs.tuned).drive_frequency
        ratio = inputs.frequency_ratio + inputs.phase_rate / frequency
        phase = inputs.phase - gained
        steady.append(replace(inputs, frequency_ratio=ratio, phase_rate=0.0, phase=phase))
        gained += inputs.phase_rate * (inputs.stop - inputs.start)
    return steady


def turning_apart(held: Sequence[HeldInputs]) -> list[HeldInputs]:
    """Return the same inputs cut where the angle of the normal load turns back.

    Before the cut the ratio falls to 0, to rounding, and after it it starts from 0.
    """
    parts: list[HeldInputs] = []
    for inputs in held:
        first, rate = inputs.frequency_ratio, inputs.ratio_rate
        turn = inputs.start - first / rate if first * rate < 0.0 else inputs.start
        if inputs.start < turn < inputs.stop:
            parts.append(replace(inputs, stop=turn))
            after = inputs.later(turn - inputs.start)
            inputs = replace(after, start=turn, frequency_ratio=0.0)
        parts.append(inputs)
    return parts
