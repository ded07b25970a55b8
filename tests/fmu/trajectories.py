"""Runs of the built FMU that are compared with the trajectory of a reference."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from slider_resonator.references.resolved.trajectory import Trajectory
from tests.fmu.host import Instantiate
from tests.fmu.native_layout import moment_of
from tests.problems import SIGNALS, Problem


def fmu_run(
    instantiate: Instantiate, problem: Problem, times: NDArray[np.float64]
) -> tuple[NDArray[np.float64], dict[str, float]]:
    """Signals (n, 6) at `times`, which must include the starts of the pieces, and end values."""
    inputs = {start: values for start, values in problem.pieces}
    first = inputs.pop(0.0)
    instance = instantiate().initialize(**problem.parameters, **first)
    rows = []
    for time in times:
        instance.step(time - instance.time)
        rows.append(instance.get(*SIGNALS))
        if time in inputs:
            instance.set(phase=0.0, load=0.0, frequency_ratio=1.0)
            instance.set(**inputs[time])
    names = ("reversals", "last_event_time", "contact_mode")
    ends = dict(zip(names, instance.get(*names), strict=True))
    return np.array(rows), ends | {"sticks": moment_of(instance.state())["sticks"]}


def assert_equal(signals: NDArray[np.float64], reference: Trajectory, allowed: float) -> None:
    """Every signal deviates by at most `allowed` of its peak."""
    for name, column in zip(SIGNALS, signals.T, strict=True):
        expected = getattr(reference, name)
        peak = np.abs(expected).max()
        deviation = np.abs(column - expected).max()
        if name == "position":
            # It is what is left of the resonator's motion, whose rounding it carries.
            rounding = 2.0 * np.spacing(np.abs(reference.resonator_displacement).max())
            deviation = max(0.0, deviation - rounding)
        assert deviation <= allowed * peak, (
            f"{name} deviates by {deviation:.3g}, {deviation / peak:.3g} of its peak; "
            f"the limit is {allowed:g}"
        )
