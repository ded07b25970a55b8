"""Measure each quantity of the vocabulary in an FMU."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks import measures
from slider_resonator.checks.conduct import (
    devices,
    experiments,
    host_calls,
    refusals,
    replays,
    states,
    variables,
)
from slider_resonator.checks.fmu_side import PREDICTIONS, FmuSide
from slider_resonator.checks.natural_scale import largest_fast_velocity
from slider_resonator.errors import NotApplicable, Refusal, SceneError
from slider_resonator.fmu.interface_check import archive_faults, description_faults
from slider_resonator.scenes.vocabulary import QUANTITIES

SHOWN = 12
"""Faults that a text names; the others are counted."""
_ESTIMATE = "slow_motion_error"
WITHIN = 0.1
"""Share of the error that `tolerance` allows up to which an error counts as none."""


def error_over_estimate(fmu: FmuSide) -> float:
    """Return the largest error of the mean velocity over the estimate of it at the same point.

    The error is that against the run of the same FMU at fidelity 2. An estimate must hold at each
    moment, also after a larger one. The start is left out: there is no mean yet. So are errors far
    below `tolerance` times v_q: nothing estimates rounding.
    NotApplicable for an FMU without estimate.
    """
    fmu.instance.fmu.variable(_ESTIMATE)
    error = np.abs(fmu.record["mean_velocity"] - fmu.resolved["mean_velocity"])[1:]
    device, held = fmu.scene.device, fmu.scene.schedule().held()
    counts = error > WITHIN * device.tolerance * largest_fast_velocity(device, held)
    with np.errstate(divide="ignore"):
        shares = error[counts] / fmu.record[_ESTIMATE][1:][counts]
    return float(shares.max(initial=0.0))


@dataclass(frozen=True)
class Measurement:
    """The value of a quantity in an FMU: number, word, None or a signal (n,).

    `note` is the reason for a None or for a count of faults; `times` (s), shape (n,), are the
    points of a signal. What is not `applicable` to the FMU has a note and no value.
    """

    value: Any
    note: str = ""
    times: Array | None = None
    applicable: bool = True


def measure(quantity: str, fmu: FmuSide) -> Measurement:
    """Measure a quantity in the FMU.

    Raises SceneError when the scene does not allow it, Refusal when the FMU refuses a call for it.
    """
    try:
        if quantity in CONDUCT:
            faults = _faults(quantity, fmu)
            more = [f"and {len(faults) - SHOWN} more"] if len(faults) > SHOWN else []
            return Measurement(float(len(faults)), "; ".join([*faults[:SHOWN], *more]))
        with fmu.instance.explained():
            value = MEASURES[quantity](fmu) if quantity in MEASURES else _output(quantity, fmu)
    except NotApplicable as error:
        return Measurement(None, str(error), applicable=False)
    except (measures.NoOscillation, np.linalg.LinAlgError, ArithmeticError) as error:
        return Measurement(None, f"{quantity} does not exist: {error}")
    except (ValueError, RuntimeError) as error:
        where = f"{fmu.scene.source}: {quantity}"
        raise SceneError(f"{where} cannot be measured: {error}") from error
    if QUANTITIES[quantity].kind == "signal":
        return Measurement(value, times=fmu.record.times[-len(value) :])
    if value is None:
        search = fmu.steady if quantity == "steady_velocity" else fmu.blocking
        return Measurement(None, search.reason)
    return Measurement(value)


def measure_all(fmu: FmuSide) -> tuple[Measurement, ...]:
    """Measure each expectation of the scene in turn; SceneError as `measure` raises it."""
    return tuple(measure(expect.quantity, fmu) for expect in fmu.scene.expect)


def _faults(quantity: str, fmu: FmuSide) -> list[str]:
    """Return the faults of conduct; a failed call is one more, or a Refusal where it is alone."""
    faults: list[str] = []
    try:
        with fmu.instance.explained():
            faults.extend(CONDUCT[quantity](fmu))
    except Refusal as error:
        if not faults:
            raise
        faults.append(f"and then {error}")
    if fmu.instance.warned:
        faults.append(f"{fmu.instance.warned} is answered with a warning")
    return faults


def _output(quantity: str, fmu: FmuSide) -> Any:
    """Return the output that a quantity is: in the run, or at its end.

    Raises NotApplicable for one at the end that the FMU lacks.
    """
    name = PREDICTIONS.get(quantity, quantity.removesuffix("_in_run"))
    if QUANTITIES[quantity].kind == "signal":
        return fmu.record[name]
    fmu.instance.fmu.variable(name)
    return fmu.record.final(name)


def _frequency_in_later_half(fmu: FmuSide, signal: str) -> float:
    half = len(fmu.record.times) // 2
    return measures.dominant_frequency(fmu.record.times[half:], fmu.record[signal][half:])


MEASURES: Mapping[str, Callable[[FmuSide], Any]] = {
    "steady_velocity": lambda fmu: fmu.steady.steady_velocity,
    "steady_status": lambda fmu: fmu.steady.status,
    "steady_periods": lambda fmu: fmu.steady.periods,
    "blocking_force": lambda fmu: fmu.blocking.blocking_force,
    "blocking_status": lambda fmu: fmu.blocking.status,
    "blocking_periods": lambda fmu: fmu.blocking.periods,
    "predicted_velocity": lambda fmu: fmu.steady.predicted,
    "predicted_blocking_force": lambda fmu: fmu.blocking.predicted,
    "slow_displacement": lambda fmu: measures.slow_displacement(
        fmu.record.times, fmu.record["position"], fmu.scene.drive_period
    ),
    "last_step_velocity": lambda fmu: float(
        np.diff(fmu.record["position"][-2:])[0] / np.diff(fmu.record.times[-2:])[0]
    ),
    "error_over_estimate": error_over_estimate,
    "event_times": lambda fmu: (
        (fmu.record["last_event_time"] - fmu.scene.start_time) / fmu.scene.drive_period
    ),
    "ripple_amplitude": lambda fmu: measures.ripple_amplitude(
        fmu.record.times, fmu.record["position"], fmu.scene.drive_period
    ),
    "ripple_frequency": lambda fmu: _frequency_in_later_half(fmu, "velocity"),
    "beat_frequency": lambda fmu: _frequency_in_later_half(fmu, "mean_velocity"),
}
"""Quantity to the function that measures it; all others are outputs of the FMU. None stands for a
value that does not exist."""

CONDUCT: Mapping[str, Callable[[FmuSide], Iterable[str]]] = {
    "reset_differences": replays.reset_differences,
    "restored_differences": replays.restored_differences,
    "transferred_differences": replays.transferred_differences,
    "beside_differences": replays.beside_differences,
    "overwritten_differences": replays.overwritten_differences,
    "separate_differences": replays.separate_differences,
    "reading_differences": replays.reading_differences,
    "rate_differences": replays.rate_differences,
    "other_device_differences": replays.other_device_differences,
    "refusal_faults": refusals.refusal_faults,
    "start_faults": variables.start_faults,
    "description_faults": lambda fmu: [
        *description_faults(fmu.instance.fmu.description),
        *archive_faults(fmu.instance.fmu.folder.resolve(), fmu.instance.fmu.description),
    ],
    "dependency_faults": variables.dependency_faults,
    "device_faults": devices.device_faults,
    "experiment_faults": experiments.experiment_faults,
    "host_faults": host_calls.host_faults,
    "state_faults": states.state_faults,
}
"""Quantity to the function that finds what it counts: faults, in words."""
