"""An FMU as a method of a benchmark."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.device.schedule import Schedule
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.studies.benchmark.cost import Outcome


def run_fmu(
    instance: Instance, parameters: Mapping[str, float], period: float, periods: int, step: int
) -> Outcome:
    """Follow `periods` drive periods of `period` (s) in communication steps of `step` periods."""
    times = period * np.arange(0, periods + 1, step, dtype=np.float64)
    record = run(
        instance, parameters, Schedule(times), outputs=("position", "velocity", "reversals")
    )
    return Outcome(
        record.times,
        record["position"],
        record["velocity"],
        round(record.final("reversals")),
        len(record.times) - 1,
        None,
    )


def parameters(device: Device) -> dict[str, float]:
    """What differs from table 1, as parameters of the FMU."""
    table_1 = asdict(Device())
    return {name: value for name, value in asdict(device).items() if value != table_1[name]}
