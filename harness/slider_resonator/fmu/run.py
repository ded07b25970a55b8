"""Running an FMU over a schedule of inputs and communication points."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from slider_resonator.device.interface import INPUTS, OUTPUTS
from slider_resonator.device.schedule import Schedule
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.record import Record


def run(
    instance: Instance,
    parameters: Mapping[str, float],
    schedule: Schedule,
    *,
    outputs: Sequence[str] = tuple(OUTPUTS),
    progress: Callable[[float], None] = lambda share: None,
) -> Record:
    """Run the schedule from the given parameters and return the outputs at all its points.

    `progress` is called about a hundred times with the share of the points that is done. Raises
    FmuError and Refusal as `Instance.start` and `Instance.check_steps` do.
    """
    times = schedule.times
    inputs = schedule.sampled()
    held = inputs.tolist()
    values = np.empty((len(times), len(outputs)))
    began, began_cpu = time.perf_counter(), time.process_time()
    first = dict(zip(INPUTS, held[0], strict=True))
    instance.start({**parameters, **first}, stop_time=float(times[-1]))
    start_cpu = time.process_time() - began_cpu
    instance.check_steps(times[1:])
    block = instance.block(outputs)
    stepping_cpu = time.process_time()
    report_every = max(1, len(times) // 100)
    with instance.explained():
        values[0] = block.read()
        for index, target in enumerate(times[1:].tolist(), start=1):
            if index > 1 and held[index - 1] != held[index - 2]:
                instance.set_inputs(held[index - 1])
            instance.step_to(target)
            values[index] = block.read()
            if index % report_every == 0:
                progress(index / (len(times) - 1))
    step_cpu = time.process_time() - stepping_cpu
    wall_time = time.perf_counter() - began
    columns = {name: values[:, i].copy() for i, name in enumerate(outputs)}
    return Record(times, inputs, columns, wall_time, start_cpu, step_cpu)
