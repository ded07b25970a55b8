"""Running a case in an FMU and recording outputs and costs."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
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
        baseline = (Hold(size, BASELINE_STEPS, *case.holds[0].inputs, tuned=case.holds[0].tuned),)
        _, periods = _run(instance, replace(case, holds=baseline, start_time=0.0))
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
