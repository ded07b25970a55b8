"""A case: a device, what it gets in a run, the model that follows it, and what an FMU does."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate, pairwise
from math import tau
from statistics import median

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.device.interface import INPUTS, OUTPUTS
from slider_resonator.device.model import Model
from slider_resonator.errors import Refusal
from slider_resonator.fmu.instance import Instance

MIN_DIVISIBLE = 1e-300
"""Steps up to this size, s, are not divided."""
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
        usual = {"tolerance": 1e-6} if self.model.leaps else {}  # loose enough to leap
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
            replace(h, size=h.size / 3, count=3) if h.size > MIN_DIVISIBLE else h
            for h in self.holds
        )


SIGNALS = ("position", "velocity", "resonator_displacement", "resonator_velocity")
"""Outputs of resolved motion that are compared."""
MEAN = ("position", "mean_velocity")
"""Those of averaged motion."""


@dataclass(frozen=True)
class Observation:
    """The outputs and costs of an FMU in a case.

    `outputs` start with the first moment, each of shape (n + 1,). `others` are the last ones of
    runs that must agree, by name: in other steps, and from time 0 where the case begins at another.
    `replayed` is whether a second run was equal bit by bit.
    `worst_step` is the CPU time (s) of the most expensive step, the smaller of two runs, per drive
    period it spans (at least 1); `period_cost` is the median of a drive period of the device.
    `refusal` is the message of the FMU where it refused the case; all else is empty then.
    """

    outputs: Mapping[str, Array] = field(default_factory=dict)
    others: Mapping[str, Mapping[str, Array]] = field(default_factory=dict)
    replayed: bool = True
    worst_step: float = 0.0
    period_cost: float = 0.0
    refusal: str | None = None


def observe(instance: Instance, case: Case) -> Observation:
    """Run a case; a refusal is part of the observation. Raises FmuError for an unusable FMU.

    A random case is run once, and only what is compared is read.
    """
    try:
        if case.is_random:
            names = MEAN if case.model.averages else SIGNALS
            return Observation(_run(instance, case, names)[0])
        first, first_costs = _run(instance, case)
        second, second_costs = _run(instance, case)
        others = {"other steps": replace(case, holds=case.other_holds)}
        if case.start_time:
            others["from time 0"] = replace(case, start_time=0.0)
        ends = {
            name: {output: values[-1:] for output, values in _run(instance, other)[0].items()}
            for name, other in others.items()
        }
        size = min(case.period, case.duration)
        baseline = replace(case.holds[0], size=size, count=5)
        _, periods = _run(instance, replace(case, holds=(baseline,), start_time=0.0))
    except Refusal as refusal:
        return Observation(refusal=str(refusal))
    steps = zip(case.sizes, first_costs, second_costs, strict=True)
    return Observation(
        outputs=first,
        others=ends,
        replayed=all(np.array_equal(first[n], second[n], equal_nan=True) for n in OUTPUTS),
        worst_step=max(min(costs) / max(1.0, one / case.period) for one, *costs in steps),
        period_cost=median(periods) * case.period / size,
    )


def _run(
    instance: Instance, case: Case, names: Sequence[str] = tuple(OUTPUTS)
) -> tuple[dict[str, Array], list[float]]:
    """Run a case; return the outputs and the costs of its steps, s.

    Raises Refusal when the FMU does not take the parameters or a step.
    """
    tuned = case.holds[0].tuned
    first = dict(zip(INPUTS, case.holds[0].inputs, strict=True))
    instance.start({**case.settings, **dict(tuned), **first}, start_time=case.start_time)
    block, clock = instance.block(names), time.thread_time
    costs: list[float] = []
    with instance.explained():
        rows = [block.read()]
        for hold in case.holds:
            instance.inputs.write(hold.inputs)
            if hold.tuned != tuned:
                tuned = hold.tuned
                instance.set(dict(tuned))
            for _ in range(hold.count):
                began = clock()
                instance.step_by(hold.size)
                costs.append(clock() - began)
                rows.append(block.read())
    return dict(zip(names, np.array(rows).T, strict=True)), costs
