"""Running a cell in an FMU and recording outputs and costs."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS, OUTPUTS
from slider_resonator.errors import Refusal
from slider_resonator.fmu.instance import Instance
from slider_resonator.stress.case import Hold, MatrixCell

NAMES = tuple(OUTPUTS)
"""Outputs that are read."""
BASELINE_STEPS = 5
"""Steps of a drive period, or of the whole run if that is shorter, that measure its cost."""


@dataclass(frozen=True)
class Observation:
    """The outputs and costs of an FMU in a cell.

    `sizes` (n,) and `inputs` (n, 3) are those of each step, `outputs` (n + 1, 13) start with
    the first moment. `other` (13,) are the last outputs in the other partition, `from_zero`
    those of a run from time 0, where one was made. `replayed` is whether a second run, and steps
    after a return to a stored state, were equal bit by bit. `worst_step` is the CPU time (s) of the
    most expensive step, the smaller of two runs, per drive period it spans (at least 1);
    `period_cost` is the median of a drive period of the device. `refusal` is the message of the FMU
    where it refused the cell; all else is empty then.
    """

    sizes: Array
    inputs: Array
    outputs: Array
    other: Array
    from_zero: Array | None = None
    replayed: bool = True
    worst_step: float = 0.0
    period_cost: float = 0.0
    refusal: str | None = None

    def signal(self, name: str) -> Array:
        """Return one output over the run, shape (n + 1,)."""
        column: Array = self.outputs[:, NAMES.index(name)]
        return column


def observe(instance: Instance, cell: MatrixCell) -> Observation:
    """Run a cell; a refusal is part of the observation. Raises FmuError for an unusable FMU."""
    try:
        return _observe(instance, cell)
    except Refusal as refusal:
        none = np.empty((0, len(NAMES)))
        return Observation(np.empty(0), np.empty((0, 3)), none, np.empty(0), refusal=str(refusal))


def _observe(instance: Instance, cell: MatrixCell) -> Observation:
    begin(instance, cell, cell.start_time)
    outputs, costs = _follow(instance, cell.holds)
    begin(instance, cell, cell.start_time)
    again, costs_again = _follow(instance, cell.holds)
    costs = [min(pair) for pair in zip(costs, costs_again, strict=True)]
    replayed = bool(np.array_equal(outputs, again, equal_nan=True))
    if cell.restored:
        replayed = replayed and _replayed(instance, cell)
    from_zero = None
    if cell.from_zero:
        begin(instance, cell, 0.0)
        from_zero = _follow(instance, cell.holds)[0][-1]
    begin(instance, cell, cell.start_time)
    other, _ = _follow(instance, cell.other_holds)
    begin(instance, cell, 0.0)
    size = min(cell.period, sum(hold.size * hold.count for hold in cell.holds))
    baseline = (Hold(size, BASELINE_STEPS, *cell.holds[0].inputs),)
    _, periods = _follow(instance, baseline)
    sizes = [hold.size for hold in cell.holds for _ in range(hold.count)]
    inputs = [hold.inputs for hold in cell.holds for _ in range(hold.count)]
    return Observation(
        sizes=np.array(sizes),
        inputs=np.array(inputs),
        outputs=outputs,
        other=other[-1],
        from_zero=from_zero,
        replayed=replayed,
        worst_step=max(cost / max(1.0, size / cell.period) for size, cost in costs),
        period_cost=median(cost for _, cost in periods) * cell.period / size,
    )


def begin(instance: Instance, cell: MatrixCell, start_time: float) -> None:
    """Initialise the FMU for a cell; Refusal when it does not take the parameters."""
    first = dict(zip(INPUTS, cell.holds[0].inputs, strict=True))
    instance.start({**cell.settings, **first}, start_time=start_time)


def _follow(instance: Instance, holds: Sequence[Hold]) -> tuple[Array, list[tuple[float, float]]]:
    """Return the outputs at all points, and size and CPU time (s) of every step."""
    block = instance.block(NAMES)
    clock = time.thread_time
    costs = []
    with instance.explained():
        rows = [block.read()]
        for hold in holds:
            instance.set_inputs(hold.inputs)
            for _ in range(hold.count):
                began = clock()
                instance.step_by(hold.size)
                costs.append((hold.size, clock() - began))
                rows.append(block.read())
    return np.array(rows), costs


def _replayed(instance: Instance, cell: MatrixCell) -> bool:
    """Return whether every second step, repeated from a stored state, gives the same outputs."""
    begin(instance, cell, 0.0)
    block = instance.block(NAMES)
    slave = instance.slave
    equal = True
    with instance.explained():
        for hold in cell.holds:
            instance.set_inputs(hold.inputs)
            for index in range(hold.count):
                if index % 2:
                    instance.step_by(hold.size)
                    continue
                present = instance.time
                state = slave.getFMUstate()
                data = slave.serializeFMUstate(state)
                slave.freeFMUstate(state)
                instance.step_by(hold.size)
                first = block.read()
                state = slave.deSerializeFMUstate(data)
                slave.setFMUstate(state)
                slave.freeFMUstate(state)
                instance.time = present
                instance.step_by(hold.size)
                equal = equal and block.read() == first
    return equal
