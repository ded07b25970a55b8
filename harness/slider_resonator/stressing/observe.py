"""Running a case in an FMU and recording outputs and costs."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS, OUTPUTS
from slider_resonator.errors import Refusal
from slider_resonator.fmu.instance import Instance
from slider_resonator.stressing.case import Case, Hold

SIGNALS = ("position", "velocity", "resonator_displacement", "resonator_velocity")
"""Outputs of resolved motion that are compared."""
MEAN = ("position", "mean_velocity")
"""Those of averaged motion."""
BASELINE_STEPS = 5
"""Steps of a drive period, or of the whole run if that is shorter, that measure its cost."""


@dataclass(frozen=True)
class Observation:
    """The outputs and costs of an FMU in a case.

    `outputs` start with the first moment, each of shape (n + 1,). `other` are the last ones in the
    other partition, `from_zero` those of a run from time 0, where one was made. `replayed` is
    whether a second run was equal bit by bit.
    `worst_step` is the CPU time (s) of the most expensive step, the smaller of two runs, per drive
    period it spans (at least 1); `period_cost` is the median of a drive period of the device.
    `refusal` is the message of the FMU where it refused the case; all else is empty then.
    """

    outputs: Mapping[str, Array] = field(default_factory=dict)
    other: Mapping[str, float] | None = None
    from_zero: Mapping[str, float] | None = None
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
            return Observation(_Run(instance, case, names).outputs)
        return _observe(instance, case)
    except Refusal as refusal:
        return Observation(refusal=str(refusal))


def _observe(instance: Instance, case: Case) -> Observation:
    first, second = _Run(instance, case), _Run(instance, case)
    replayed = all(
        np.array_equal(first.outputs[name], second.outputs[name], equal_nan=True)
        for name in OUTPUTS
    )
    from_zero = _Run(instance, case, start_time=0.0).last if case.from_zero else None
    other = _Run(instance, case, holds=case.other_holds).last
    size = min(case.period, case.duration)
    baseline = (Hold(size, BASELINE_STEPS, *case.holds[0].inputs),)
    periods = _Run(instance, case, holds=baseline, start_time=0.0).costs
    steps = zip(case.sizes, first.costs, second.costs, strict=True)
    return Observation(
        outputs=first.outputs,
        other=other,
        from_zero=from_zero,
        replayed=replayed,
        worst_step=max(min(costs) / max(1.0, one / case.period) for one, *costs in steps),
        period_cost=median(periods) * case.period / size,
    )


class _Run:
    """A run of a case, or of other holds or from another time (s): outputs and costs of steps, s.

    Raises Refusal when the FMU does not take the parameters or a step.
    """

    def __init__(
        self,
        instance: Instance,
        case: Case,
        names: Sequence[str] = tuple(OUTPUTS),
        *,
        holds: Sequence[Hold] | None = None,
        start_time: float | None = None,
    ) -> None:
        _begin(instance, case, case.start_time if start_time is None else start_time)
        block, clock = instance.block(names), time.thread_time
        self.costs: list[float] = []
        tuned = case.holds[0].tuned
        with instance.explained():
            rows = [block.read()]
            for hold in holds or case.holds:
                instance.set_inputs(hold.inputs)
                if hold.tuned != tuned:
                    tuned = hold.tuned
                    instance.set(dict(tuned))
                for _ in range(hold.count):
                    began = clock()
                    instance.step_by(hold.size)
                    self.costs.append(clock() - began)
                    rows.append(block.read())
        self.outputs = dict(zip(names, np.array(rows).T, strict=True))
        self.last = dict(zip(names, rows[-1], strict=True))


def _begin(instance: Instance, case: Case, start_time: float) -> None:
    first = dict(zip(INPUTS, case.holds[0].inputs, strict=True))
    settings = case.settings | dict(case.holds[0].tuned)
    instance.start({**settings, **first}, start_time=start_time)
