"""Needs independent of time: steady velocity and blocking force, by shooting or by theory."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf

from slider_resonator.choosing.candidate import Candidate
from slider_resonator.choosing.errors import ROUNDING, ErrorEstimate
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
    """A steady quantity (m/s or N), None with the reason, and the drive periods that it took."""

    value: float | None
    reason: str
    periods: int


def find(
    instance: Instance, values: Mapping[str, float], name: str, candidate: Candidate
) -> SteadyValue:
    """Return a steady quantity as a candidate gives it: at fidelity 0 the FMU's own output.

    `values` are the parameters and inputs of the scene. Raises FmuError where the FMU refuses.
    """
    given = {**values, **candidate.parameters}
    if candidate.model.fidelity == 0:
        instance.start(given)
        with instance.explained():
            return SteadyValue(instance.value(name), "", 0)
    search: SearchResult
    if name == "steady_velocity":
        search = find_steady(instance, given)
    else:
        search = find_blocking(instance, {k: v for k, v in given.items() if k != "load"})
    value: float | None = getattr(search, name) if search.status in EXISTS[name] else None
    return SteadyValue(value, f"{search.status}: {search.reason}", search.periods)


def steady_error(found: SteadyValue, reference: SteadyValue, law: int) -> ErrorEstimate:
    """Return the error against the resolved quantity; `law` is the friction law of that."""
    if reference.value is None:
        return ErrorEstimate(inf, 0.0, reference.reason)
    if found.value is None:
        return ErrorEstimate(inf, abs(reference.value), found.reason)
    floor = max(SOLVED, ROUNDING[law]) * abs(reference.value)
    return ErrorEstimate(max(abs(found.value - reference.value), floor), abs(reference.value))
