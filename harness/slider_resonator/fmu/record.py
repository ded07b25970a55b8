"""The record of a run, and its CSV file."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.output.atomic import replacing


@dataclass(frozen=True)
class Record:
    """The inputs and outputs of an FMU at the readings of a schedule, `times` (s), shape (n,).

    `outputs` maps names to arrays (n,); `inputs` (n, 3) are phase, load, frequency_ratio as set
    at each point. `wall_time` (s) covers initialisation and stepping, `start_cpu` and
    `step_cpu` (s) are the CPU times of each.
    """

    times: Array
    inputs: Array
    outputs: Mapping[str, Array]
    wall_time: float
    start_cpu: float
    step_cpu: float

    def __getitem__(self, name: str) -> Array:
        """Return one output over the run, shape (n,); HarnessError names the nearest."""
        if name not in self.outputs:
            raise HarnessError(unknown_name("output", name, self.outputs))
        return self.outputs[name]

    def final(self, name: str) -> float:
        """Return the last value of an output; HarnessError names the nearest."""
        return float(self[name][-1])


def write_csv(record: Record, path: Path) -> None:
    """Write a run with quoted names of the variables as header, time first.

    Inputs are those held from each time on. Raises HarnessError when `path` cannot be written.
    """
    header = ["time", *INPUTS, *record.outputs]
    columns = [record.times, *record.inputs.T, *record.outputs.values()]
    with replacing(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, quoting=csv.QUOTE_ALL, lineterminator="\n").writerow(header)
        numbers = csv.writer(file, lineterminator="\n")
        numbers.writerows(zip(*(column.tolist() for column in columns), strict=True))
