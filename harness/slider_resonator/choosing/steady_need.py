"""Needs independent of time: steady velocity and blocking force, by shooting or by theory."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from math import inf

from slider_resonator.choosing.candidate import Candidate
from slider_resonator.choosing.errors import ROUNDING, ErrorEstimate
from slider_resonator.choosing.timed_run import WARM_UP
from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.search_result import SearchResult
from slider_resonator.steady.steady_velocity import find_steady

EXISTS = {"steady_velocity": ("steady", "stuck"), "blocking_force": ("blocked",)}
"""Outcomes of a search at which a device settles."""
SOLVED = 1e-10
"""Accuracy of a solution by shooting, as a share of its size, but for that of the integration."""


@dataclass(frozen=True)
class SteadyValue:
    """A steady quantity (m/s or N), None with the reason.

    `periods` are the drive periods that the search took, `seconds` (s) its CPU time.
    """

    value: float | None
    reason: str
    periods: int
    seconds: float


def find(
    instance: Instance, values: Mapping[str, float], name: str, candidate: Candidate
) -> SteadyValue:
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
        return SteadyValue(found, "", 0, time.process_time() - began)
    search: SearchResult
    if name == "steady_velocity":
        search = find_steady(instance, given)
    else:
        search = find_blocking(instance, {k: v for k, v in given.items() if k != "load"})
    seconds = time.process_time() - began
    value: float | None = getattr(search, name) if search.status in EXISTS[name] else None
    return SteadyValue(value, f"{search.status}: {search.reason}", search.periods, seconds)


def steady_error(found: SteadyValue, reference: SteadyValue, law: int) -> ErrorEstimate:
    """Return the error against the resolved quantity; `law` is the friction law of that."""
    if reference.value is None:
        return ErrorEstimate(inf, 0.0, reference.reason)
    if found.value is None:
        return ErrorEstimate(inf, abs(reference.value), found.reason)
    floor = max(SOLVED, ROUNDING[law]) * abs(reference.value)
    return ErrorEstimate(max(abs(found.value - reference.value), floor), abs(reference.value))
