"""What an FMU gives in place of the measurements, with given parameters."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.fitting.measurements import Measurements, Point
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.steady_velocity import find_steady


def predict(
    instance: Instance, parameters: Mapping[str, float], measurements: Measurements
) -> Array:
    """Return the numbers of the FMU in the order of `Measurements.measured`, shape (n,).

    A steady quantity is the FMU's output where that is valid, else it is found by shooting; where
    no such motion exists it is NaN. Raises FmuError and Refusal as `Instance.start` does.
    """
    numbers = [_steady(instance, parameters, point) for point in measurements.points]
    columns = []
    for one in measurements.runs:
        record = run(instance, parameters, one.schedule, outputs=list(one.outputs))
        columns += [
            record.outputs[name][np.isfinite(column)] for name, column in one.outputs.items()
        ]
    return np.concatenate([numbers, *columns])


def _steady(instance: Instance, parameters: Mapping[str, float], point: Point) -> float:
    values = {**parameters, **point.values}
    has_validity = "prediction_valid" in instance.fmu.outputs
    instance.start(values)
    with instance.explained():
        read = instance.read([point.quantity, *(["prediction_valid"] if has_validity else [])])
    if read.get("prediction_valid") == 1.0:
        return read[point.quantity]
    if point.quantity == "steady_velocity":
        found = find_steady(instance, values).steady_velocity
    else:
        found = find_blocking(instance, values).blocking_force
    return float("nan") if found is None else found
