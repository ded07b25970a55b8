"""A case: a device, what it gets in a run, and the model that follows it."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise
from math import tau

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.device.model import Model

SUBSTEPS = 3
"""Substeps per step in the second partition of a case, for steps that do not repeat."""
MIN_DIVISIBLE = 1e-300
"""Steps up to this size, s, are not divided."""
LEAP_TOLERANCE = 1e-6
"""Tolerance under which averages of second order leap over periods, where none is given."""
MARGIN = 10.0
"""Largest error of the slow velocity in leaps, over `tolerance` times the fast velocity."""
RANDOM = "random device"
"""Axis of the cases that are drawn."""
DEVICE = "device"
"""Beginning of the axis of the cases of a device file or an example."""


@dataclass(frozen=True)
class Hold:
    """Inputs (rad, N, 1) held over `count` communication steps of `size` (s).

    `tuned` are the tunable parameters that the run changes, by name.
    """

    size: float
    count: int = 1
    phase: float = 0.4
    load: float = 0.0
    frequency_ratio: float = 1.0
    tuned: tuple[tuple[str, float], ...] = ()

    @property
    def inputs(self) -> tuple[float, float, float]:
        """Phase, load, frequency_ratio."""
        return self.phase, self.load, self.frequency_ratio

    @property
    def duration(self) -> float:
        """Time of all its steps, s."""
        return self.size * self.count


MODELS = (
    *(Model(2, 0), Model(1, 0), Model(0, 0, 1), Model(2, 1), Model(1, 1), Model(0, 1, 1)),
    *(Model(0, 0, 2), Model(0, 1, 2)),
)
"""All models, in the order in which random devices take them in turn."""


def name_of(model: Model) -> str:
    """Return a model as the names of cases have it."""
    return f"{model.law}, {model.resolution.removesuffix(', order 1')}"


@dataclass(frozen=True)
class Limit:
    """A limit case: the value that an output must have at the end, and the reason."""

    output: str
    value: float
    allowed: float
    why: str


@dataclass(frozen=True)
class Case:
    """One run: the value `value` on the axis `axis`, by one model.

    `parameters` are those that differ from table 1.
    """

    axis: str
    value: str
    model: Model
    parameters: Mapping[str, float]
    holds: tuple[Hold, ...]
    start_time: float = 0.0
    limits: tuple[Limit, ...] = ()

    @property
    def name(self) -> str:
        """Axis, value and model."""
        return f"{self.axis}: {self.value}: {name_of(self.model)}"

    @property
    def is_random(self) -> bool:
        """Whether its device is drawn: it is run once and judged by its reference alone."""
        return self.axis == RANDOM

    @property
    def settings(self) -> dict[str, float]:
        """All parameters that are set in the FMU."""
        usual = {"tolerance": LEAP_TOLERANCE} if self.model.leaps else {}
        return {**usual, **self.parameters, **self.model.parameters}

    @property
    def device(self) -> Device:
        """The device at the start."""
        return Device.from_mapping(self.settings)

    @property
    def period(self) -> float:
        """The drive period, s."""
        return tau / self.device.drive_frequency

    @property
    def duration(self) -> float:
        """Time of all steps, s."""
        return sum(hold.duration for hold in self.holds)

    @property
    def sizes(self) -> Array:
        """Size of each step (s), shape (n,)."""
        return np.repeat([h.size for h in self.holds], [h.count for h in self.holds])

    @property
    def inputs(self) -> Array:
        """Phase (rad), load (N) and frequency ratio of each step, shape (n, 3)."""
        return np.repeat([h.inputs for h in self.holds], [h.count for h in self.holds], axis=0)

    @property
    def times(self) -> Array:
        """Times of the communication points (s) from 0 on, shape (n + 1,)."""
        return np.concatenate([[0.0], np.cumsum(self.sizes)])

    @property
    def held(self) -> list[HeldInputs]:
        """The inputs for references, from time 0 on, equal neighbours merged."""
        ends = self.times[[0, *accumulate(hold.count for hold in self.holds)]].tolist()
        held: list[HeldInputs] = []
        for (start, stop), hold in zip(pairwise(ends), self.holds, strict=True):
            one = HeldInputs(start, stop, *hold.inputs, tuned=hold.tuned)
            if held and replace(held[-1], start=start, stop=stop) == one:
                held[-1] = replace(held[-1], stop=stop)
            else:
                held.append(one)
        return held

    @property
    def other_holds(self) -> tuple[Hold, ...]:
        """The same inputs over the same times in other steps: repeated merged, others divided."""
        if any(hold.count > 1 for hold in self.holds):
            return tuple(replace(h, size=h.duration, count=1) for h in self.holds)
        return tuple(
            replace(h, size=h.size / SUBSTEPS, count=SUBSTEPS) if h.size > MIN_DIVISIBLE else h
            for h in self.holds
        )
