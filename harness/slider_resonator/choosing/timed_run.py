"""A candidate's run of a scene, with the CPU time that it takes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from slider_resonator.device.model import COULOMB
from slider_resonator.device.schedule import Schedule
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.record import Record
from slider_resonator.fmu.run import run

SIGNALS = ("position", "velocity", "mean_velocity", "reversals", "last_event_time")
WARM_UP = {"fidelity": 2.0, "friction_law": float(COULOMB)}
"""A model that prepares nothing which another one could use."""
WARM_UP_STEP = 1e-3
"""Share of the first communication step."""


def timed_run(
    instance: Instance, parameters: Mapping[str, float], schedule: Schedule
) -> tuple[Record, float]:
    """Return a run and its CPU time (s), in a new instance: an old one may keep tables.

    The host's own first calls are made before. Raises FmuError or Refusal where the FMU cannot run
    it, or gives what is not finite.
    """
    instance.recreate()
    first = replace(schedule, times=schedule.times[:2] * WARM_UP_STEP)
    run(instance, {**parameters, **WARM_UP}, first, outputs=SIGNALS)
    record = run(instance, parameters, schedule, outputs=SIGNALS)
    for name in SIGNALS:
        if not np.isfinite(record[name]).all():
            raise FmuError(f"{instance.fmu.path.name}: output {name} is not finite")
    return record, record.start_cpu + record.step_cpu
