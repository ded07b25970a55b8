"""What a candidate gives and costs: its run of a scene, its steady velocity and blocking force."""

import time
from collections.abc import Mapping
from dataclasses import replace
from math import inf

import numpy as np

from slider_resonator.choosing.candidate import Candidate
from slider_resonator.choosing.errors import ROUNDING, ErrorEstimate
from slider_resonator.device.model import COULOMB
from slider_resonator.device.schedule import Schedule
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import Record, run
from slider_resonator.steady.searches import SEARCHES, SteadyAnswer

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


EXISTS = {"steady_velocity": ("steady", "stuck"), "blocking_force": ("blocked",)}
"""Outcomes of a search at which a device settles."""
SOLVED = 1e-10
"""Accuracy of a solution by shooting, as a share of its size, but for that of the integration."""


def find(
    instance: Instance, values: Mapping[str, float], name: str, candidate: Candidate
) -> SteadyAnswer:
    """Return a steady quantity as a candidate gives it: at fidelity 0 the FMU's own output.

    `values` are the parameters and inputs of the scene. The instance is created anew, as an old one
    may keep predictions. Raises FmuError where the FMU refuses.
    """
    given = {**values, **candidate.parameters}
    instance.recreate()
    instance.start({**given, **WARM_UP})
    began = time.process_time()
    if candidate.model.fidelity == 0:
        instance.start(given)
        with instance.explained():
            found = instance.value(name)
        return SteadyAnswer(time.process_time() - began, found)
    if name == "blocking_force":
        given.pop("load", None)  # the search begins where the FMU predicts it
    search = SEARCHES[name](instance, given)
    seconds = time.process_time() - began
    value: float | None = getattr(search, name) if search.status in EXISTS[name] else None
    return SteadyAnswer(seconds, value, f"{search.status}: {search.reason}", search.periods)


def steady_error(found: SteadyAnswer, reference: SteadyAnswer, law: int) -> ErrorEstimate:
    """Return the error against the resolved quantity; `law` is the friction law of that."""
    if reference.value is None:
        return ErrorEstimate(inf, 0.0, reference.reason)
    if found.value is None:
        return ErrorEstimate(inf, abs(reference.value), found.reason)
    floor = max(SOLVED, ROUNDING[law]) * abs(reference.value)
    return ErrorEstimate(max(abs(found.value - reference.value), floor), abs(reference.value))
