"""Inputs held constant over an interval, as an FMU holds them over a communication step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device


@dataclass(frozen=True)
class HeldInputs:
    """Inputs constant over ``[start, stop]`` (s): phase (rad), load (N), frequency_ratio (1)."""

    start: float
    stop: float
    phase: float = 0.0
    load: float = 0.0
    frequency_ratio: float = 1.0

    def tuned_device(self, device: Device) -> Device:
        """Return the device of a run as it is over these inputs."""
        return device


@dataclass(frozen=True)
class TunedInputs(HeldInputs):
    """Held inputs together with the tunable parameters that a run changes, by name."""

    tuned: tuple[tuple[str, float], ...] = ()

    def tuned_device(self, device: Device) -> Device:
        """Return the device of a run with the parameters as they are over these inputs."""
        values: dict[str, Any] = dict(self.tuned)
        return replace(device, **values)


def check_contiguous(held: Sequence[HeldInputs]) -> None:
    """Raise ValueError unless ``held`` is a gapless sequence of intervals of positive length."""
    if not held:
        raise ValueError("held inputs: at least one interval is needed, got none")
    for index, inputs in enumerate(held):
        if not inputs.stop > inputs.start:
            raise ValueError(
                f"held inputs {index}: stop = {inputs.stop!r} s must be greater than "
                f"start = {inputs.start!r} s"
            )
        if index and inputs.start != held[index - 1].stop:
            raise ValueError(
                f"held inputs {index}: start = {inputs.start!r} s must equal the stop of the "
                f"interval before, {held[index - 1].stop!r} s"
            )


def check_times(times: Array, held: Sequence[HeldInputs]) -> None:
    """Raise ValueError unless ``times`` (s) are one ascending row within the held inputs."""
    start, stop = held[0].start, held[-1].stop
    if times.ndim != 1 or not (np.diff(times) >= 0.0).all():
        raise ValueError(f"times of shape {times.shape!r} must be one ascending row")
    if times.size and not (start <= times[0] and times[-1] <= stop):
        raise ValueError(
            f"times from {float(times[0])!r} to {float(times[-1])!r} s must lie within the held "
            f"inputs, {start!r} to {stop!r} s"
        )
