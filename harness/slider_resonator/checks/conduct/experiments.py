"""Experiments as hosts set them up: sums of steps, a tolerance, outputs read at the end."""

import math
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from math import isclose, sqrt

import numpy as np

from slider_resonator.arrays import is_same
from slider_resonator.checks.conduct.findings import accepted, is_refused, outputs_after
from slider_resonator.checks.conduct.output_derivatives import status_faults
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.fmu.instance import Instance

EVENT = "last_event_time"
"""The output that counts from the start time."""

STEP, STEPS = 0.01, 6
"""Steps (s) that add up to more than their product, by rounding."""
STEPS_ACCEPTED: Sequence[tuple[float, Mapping[str, float]]] = (
    (1e-11, {}),
    (4.0, {"fidelity": 1.0}),
    (2e4, {"fidelity": 0.0, "averaging_order": 1.0}),
    (
        0.1,
        {
            "friction_law": 1.0,
            "bristle_stiffness": 1e9,
            "bristle_damping": 0.0,
            "base_amplitude": 0.0,
            "drive_frequency": 10.0,
            "resonator_frequency": 10.0,
            "normal_amplitude": 0.5,
            "initial_velocity": 1e-7,
        },
    ),
    (1e-3, {"fidelity": 1.0, "damping_ratio": 1e-9, "resonator_frequency": 3500.0 / sqrt(1.1)}),
)
"""Steps (s) that must be accepted, and devices: very short ones, of 2000 drive periods, of 11
million that are not resolved, of a slider that trembles on hard bristles under a slow drive, of
next to no damping at resonance."""
SHORT, MANY, TOGETHER = 1e-5, 120_000, 1000
"""Steps (s) of a host that samples the motion, their number, and how many another takes in one."""
EARLY = -3.0
"""The time (s) at which these steps begin."""
BRISTLES = {"friction_law": 1.0, "bristle_stiffness": 1e4}
"""A device that its parameter `tolerance` acts on."""
TOLERANCES = (1e-2, 1e-3, 1e-6, 1e-10)
"""Tolerances that hosts define for an experiment."""


def experiment_faults(fmu: FmuSide) -> Iterator[str]:
    """Run a few steps in experiments that must be accepted and not change the motion.

    Values are set before the experiment is set up, and no step may be taken back.
    """
    instance = fmu.instance
    for what, experiment in (
        ("up to a stop time that sums of steps exceed by rounding", (False, 0.0)),
        *((f"with a tolerance of {tolerance:g}", (True, tolerance)) for tolerance in TOLERANCES),
        ("with a tolerance that is not defined", (False, -1.0)),
        ("with a tolerance of NaN that is not defined", (False, math.nan)),
    ):
        faults = _run_faults(instance, what, experiment)
        yield from accepted(instance, f"an experiment {what}", faults)
    for start, stop in ((EARLY, EARLY), (0.0, sys.float_info.max)):
        what = f"an experiment from {start:g} s to {stop:g} s"
        yield from accepted(instance, what, _span_faults(instance, start, stop))
    yield from _early_faults(instance)
    if instance.fmu.runs_without_python:
        yield from _many_steps_faults(instance)
    for size, device in STEPS_ACCEPTED:
        yield from accepted(instance, f"a step of {size:g} s", _step_faults(instance, size, device))


def _span_faults(instance: Instance, start: float, stop: float) -> Iterator[str]:
    """Start an experiment (s), and end it before a step."""
    instance.start({}, start_time=start, stop_time=stop)
    instance.outputs()
    if stop == start and not is_refused(instance.step_by, STEP):
        yield f"a step beyond the stop time {stop:g} s is accepted"
    instance.terminate()


def _step_faults(instance: Instance, size: float, device: Mapping[str, float]) -> Iterator[str]:
    """Make two steps (s) with a device."""
    known = {n: v for n, v in device.items() if n in instance.fmu.variables}
    instance.start(known, start_time=EARLY)
    if not is_same(instance.value(EVENT), EARLY):
        yield "last_event_time does not begin at the start time"
    instance.step_by(size)
    instance.step_by(size)
    yield from status_faults(instance)


def _early_faults(instance: Instance) -> Iterator[str]:
    """Run a device before time 0, whose motion is that from time 0 on."""
    rows = []
    for start_time in (0.0, EARLY):
        instance.start({"phase": 0.4}, start_time=start_time)
        rows.append(outputs_after(instance, STEP, STEPS))
    for name, value in rows[0].items():
        early = rows[1][name]  # which the rounding of times may change
        if name != EVENT and not isclose(early, value, rel_tol=1e-9, abs_tol=1e-9):
            yield f"{name} is {early!r} from {EARLY:g} s on, and {value!r} from 0 s on"


def _many_steps_faults(instance: Instance) -> Iterator[str]:
    """Run a device in very many steps, or those of a while, which must end where few do."""
    instance.start({"phase": 0.4})
    times, steps = [time.monotonic()], 0
    while steps < MANY and times[-1] < times[0] + 5.0:  # by then a slow FMU has taken enough
        for _ in range(TOGETHER):
            instance.step_by(SHORT)
        steps += TOGETHER
        times.append(time.monotonic())
    taken = np.diff(times)
    slower = taken[-5:].min() / taken[:2].max()
    if slower > 5.0:
        yield f"steps take {slower:.0f} times as long after {steps}"
    found = instance.outputs()
    instance.start({"phase": 0.4})
    expected = outputs_after(instance, TOGETHER * SHORT, steps // TOGETHER)
    for name, value in expected.items():
        if not isclose(found[name], value, rel_tol=1e-7, abs_tol=1e-7):
            yield f"{name} is {found[name]!r} after {steps} steps, must be {value!r}, as after few"


def _run_faults(instance: Instance, what: str, tolerance: tuple[bool, float]) -> Iterator[str]:
    instance.start(BRISTLES)
    expected = outputs_after(instance, STEP, STEPS)
    instance.set_up()
    instance.call("fmi2Reset")
    instance.set(BRISTLES)
    instance.call("fmi2SetupExperiment", *tolerance, 0.0, True, STEPS * STEP)
    instance.call("fmi2EnterInitializationMode")
    instance.begin()
    for _ in range(STEPS):
        instance.call("fmi2DoStep", instance.time, STEP, False)
        instance.time += STEP
    if instance.outputs() != expected:
        yield f"an experiment {what} gives other outputs"
    instance.terminate()
    if instance.outputs() != expected:
        yield f"outputs differ after the end of an experiment {what}"
