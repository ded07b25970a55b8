"""A run as a CSV file: time, inputs, outputs, all digits."""

from __future__ import annotations

import csv
from pathlib import Path

from slider_resonator.device.interface import INPUTS
from slider_resonator.fmu.record import Record
from slider_resonator.output.atomic import replacing


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
