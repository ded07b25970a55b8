"""The record of a run."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS, VARIABLES
from slider_resonator.errors import HarnessError, unknown_name
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
