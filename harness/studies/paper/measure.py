"""Measurements for the report: records of short runs, velocities and forces by shooting."""

from collections.abc import Mapping

from slider_resonator.device.interface import INPUTS
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import Record, run
from slider_resonator.steady.searches import SearchResult, find_blocking, find_steady

SIGNALS = ("position", "velocity")


def record(instance: Instance, values: Mapping[str, float], stop: float, points: int) -> Record:
    """Run from 0 to ``stop`` (s) in ``points`` equal steps; return position and velocity."""
    signals = {name: constant(value) for name, value in values.items() if name in INPUTS}
    parameters = {name: value for name, value in values.items() if name not in INPUTS}
    return run(instance, parameters, schedule(stop, stop / points, **signals), outputs=SIGNALS)


def plain(found: Record) -> dict[str, list[float]]:
    """Return time, position and velocity as lists."""
    return {"time": found.times.tolist(), **{name: found[name].tolist() for name in SIGNALS}}


def steady_motion(
    instance: Instance, values: Mapping[str, float]
) -> tuple[float, Mapping[str, float]]:
    """Return the steady velocity in m/s by shooting, and the state; FmuError without one."""
    steady = find_steady(instance, values)
    return _found(steady.steady_velocity, steady, instance, values), steady.state


def steady_velocity(instance: Instance, values: Mapping[str, float]) -> float:
    """Return the steady velocity in m/s by shooting; FmuError, with the reason, without one."""
    return steady_motion(instance, values)[0]


def blocking_force(instance: Instance, values: Mapping[str, float]) -> float:
    """Return the load in N that stops the device; FmuError, with the reason, without one."""
    blocking = find_blocking(instance, values)
    return _found(blocking.blocking_force, blocking, instance, values)


def _found(
    value: float | None, search: SearchResult, instance: Instance, values: Mapping[str, float]
) -> float:
    if value is None:
        raise FmuError(f"{instance.fmu.path.name}: {dict(values)}: {search.reason}")
    return value
