"""Running an FMU over a schedule of inputs and communication points, and the record of that."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS, VARIABLES
from slider_resonator.device.schedule import Schedule
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.fmu.instance import Instance
from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.output.readable import number_of, readable
from slider_resonator.output.shown import Shown, Tabular


@dataclass(frozen=True, repr=False)
class Record(Shown, Tabular):
    """The inputs and outputs of an FMU at the readings of a schedule, `times` (s), shape (n,).

    `outputs` maps names to arrays (n,); `inputs` (n, 3) are phase, load, frequency_ratio as set
    at each point, `tuned` what else the schedule changes: tunable parameters, deviations of the
    drive. `wall_time` (s) covers initialisation and stepping, `start_cpu` and `step_cpu` (s) are
    the CPU times of each.
    """

    times: Array
    inputs: Array
    outputs: Mapping[str, Array]
    wall_time: float
    start_cpu: float
    step_cpu: float
    tuned: Mapping[str, Array] = field(default_factory=dict, kw_only=True)

    def __getitem__(self, name: str) -> Array:
        """Return a column of `table`, shape (n,); HarnessError names the nearest."""
        table = self.table()
        if name not in table:
            raise HarnessError(unknown_name("column", name, table))
        return table[name]

    def final(self, name: str) -> float:
        """Return the last value of a column; HarnessError names the nearest."""
        return float(self[name][-1])

    @property
    def given(self) -> dict[str, Array]:
        """The inputs, and what else the schedule changes, as held from each time on, by name."""
        return {**dict(zip(INPUTS, self.inputs.T, strict=True)), **self.tuned}

    def table(self) -> dict[str, Array]:
        """Return time, what was given from each time on, and outputs, by name."""
        return {"time": self.times, **self.given, **self.outputs}

    def describe(self) -> list[str]:
        """Return the span of the run and the outputs at its end."""
        points = number_of(len(self.times), "point")
        lines = [
            f"{points} from {self.times[0]:.6g} s to {self.times[-1]:.6g} s, "
            f"{self.wall_time:.3g} s of wall time; at the end:"
        ]
        for name in self.outputs:
            unit = VARIABLES[name].unit.removeprefix("1")
            lines.append(f"{name:<24}{readable(self.final(name), 9)} {unit}".rstrip())
        return lines


def run(
    instance: Instance,
    parameters: Mapping[str, float],
    schedule: Schedule,
    *,
    outputs: Sequence[str] | None = None,
    progress: Progress = no_progress,
) -> Record:
    """Run the schedule from the given parameters and return the outputs at all its readings.

    Without `outputs` all that the FMU has are read. Parameters that the schedule tunes start as it
    says. `progress` is called about a hundred times, without a label, with the share of the points
    that is done. Raises FmuError and Refusal as `Running.start` does, NotApplicable as `Running`.
    """
    running = Running(instance, schedule, outputs)
    began, began_cpu = time.perf_counter(), time.process_time()
    running.start(parameters)
    stepping_cpu = time.process_time()
    report_every = max(1, running.steps // 100)
    with instance.explained():
        running.read()
        for step in range(running.steps):
            running.advance(step)
            if (step + 1) % report_every == 0:
                progress("", (step + 1) / running.steps)
    start_cpu, step_cpu = stepping_cpu - began_cpu, time.process_time() - stepping_cpu
    wall_time = time.perf_counter() - began
    readings, values = schedule.readings(), np.array(running.rows)
    held = np.searchsorted(schedule.times, readings, side="right") - 1
    tuned = dict(zip(schedule.tuning, schedule.tuned[held].T, strict=True))
    columns = {name: values[:, i].copy() for i, name in enumerate(running.outputs)}
    inputs = schedule.sampled[held]
    return Record(readings, inputs, columns, wall_time, start_cpu, step_cpu, tuned=tuned)


class Running:
    """A run of a schedule on an instance in `steps`; `rows` are the outputs read so far.

    `first` are the inputs and tuned parameters with which the instance must be started, `span` are
    start and end (s) as arguments of `Instance.start`. Raises NotApplicable for a schedule with
    ramps that it interpolates, on an FMU that cannot.
    """

    def __init__(
        self, instance: Instance, schedule: Schedule, outputs: Sequence[str] | None = None
    ) -> None:
        self.instance = instance
        self.outputs = instance.fmu.outputs if outputs is None else tuple(outputs)
        self.rows: list[list[float]] = []
        self._ramps = schedule.ramps
        if self._ramps:
            instance.fmu.require("canInterpolateInputs")
        self._schedule = schedule
        self._times = schedule.times.tolist()
        self._changes = set(schedule.changes.tolist())
        self._block = instance.block(self.outputs)
        self._names = (*INPUTS, *schedule.tuning)
        self.first = self.values_at(0)
        self.steps = len(self._times) - 1
        start = schedule.start_time
        self.span = {"stop_time": float(start + self._times[-1]), "start_time": start}

    def start(self, parameters: Mapping[str, float]) -> None:
        """Start the instance with parameters and `first`.

        Raises as `Instance.start` and `Instance.check_steps` do.
        """
        self.instance.start({**parameters, **self.first}, **self.span)
        self.instance.check_steps(self._schedule.start_time + self._schedule.times[1:])

    def read(self) -> None:
        """Read the outputs into a new row."""
        self.rows.append(self._block.read())

    def step_size(self, step: int) -> float:
        """Return the size (s) of a step."""
        return float(self._times[step + 1] - self._times[step])

    def values_at(self, step: int) -> dict[str, float]:
        """Return the inputs and tuned parameters over a step."""
        sampled, tuned = self._schedule.sampled[step], self._schedule.tuned[step]
        return dict(zip(self._names, [*sampled.tolist(), *tuned.tolist()], strict=True))

    def advance(self, step: int, before: Callable[[], None] | None = None) -> None:
        """Set what changes, read where the schedule says so, call `before`, step and read."""
        schedule = self._schedule
        if step in self._changes:
            self.instance.inputs.write(schedule.sampled[step].tolist())
            if self._ramps:
                self.instance.inputs.write_rates(schedule.rates[step].tolist())
            if schedule.tuning:
                self.instance.block(list(schedule.tuning)).write(schedule.tuned[step].tolist())
            if schedule.reads_twice:
                self.read()
        elif step == 0 and self._ramps:
            self.instance.inputs.write_rates(schedule.rates[0].tolist())
        if before is not None:
            before()
        start, target = schedule.start_time, self._times[step + 1]
        if start:  # what the schedule says, not the sum of rounded steps
            self.instance.time = start + self._times[step]
            self.instance.step_by(target - self._times[step])
        else:
            self.instance.step_to(target)
        self.read()

    def finish(self, begin: int = 0, end: int | None = None) -> None:
        """Advance from a step on to another or to the end."""
        for step in range(begin, self.steps if end is None else end):
            self.advance(step)
