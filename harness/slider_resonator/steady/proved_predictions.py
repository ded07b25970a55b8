"""Steady velocities and blocking forces that an FMU predicts, proved by its own motion.

An FMU with `averaging_order` 2 finds the periodic motion itself. To prove what it says, some common
periods are run from the vibration without friction on, at the mean velocity in question. Near a
periodic motion the map of a period is linear: its matrix follows from the changes over successive
periods (dynamic mode decomposition), and the limit of the sequence from the matrix. The mean
velocity of the limit must be the one that was predicted, and the motion must be stable.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite, tau

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.common_period import common_period
from slider_resonator.device.device import Device
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.resolved.equations import steady_vibration
from slider_resonator.steady.periodic import STATE
from slider_resonator.steady.shooting import NEUTRAL

PERIODS = 5
"""Common periods of a run: four changes of the state, of three entries and the travel."""
PROVEN = 1e-8
"""Largest error of the mean velocity, in units of the amplitude of the vibration."""
NEAR = 1e-3
"""Largest distance from the limit, in units of the vibration: the map is linear to its square."""
RESTARTS = 4
"""Further runs, each from the limit of the one before."""
RANK = 1e-9
"""Smallest over largest change that counts."""

DEVICE = (
    *("slider_mass", "resonator_mass", "resonator_frequency", "damping_ratio", "drive_frequency"),
    *("base_amplitude", "tangential_force", "friction_law", "fidelity", "averaging_order"),
)
PREDICTIONS = ("steady_velocity", "blocking_force", "prediction_valid")
INITIAL = tuple(f"initial_{name}" for name in STATE)
READ = (*STATE, "position", "stick_fraction")


@dataclass(frozen=True)
class _Candidate:
    """A prediction and the motion that belongs to it.

    `start` and `scale` (3,) are those of the entries of `STATE`, `period` (s) is the common period,
    `velocity` (m/s) the mean velocity that the motion must have.
    """

    prediction: float
    values: Mapping[str, float]
    velocity: float
    period: float
    start: Array
    scale: Array


def proved_prediction(
    instance: Instance, quantity: str, values: Mapping[str, float], max_denominator: int
) -> float | None:
    """Return what the FMU predicts for a `steady_velocity` or `blocking_force`, None if unproved.

    `values` are parameters and inputs by name. Only Coulomb friction of the full device is proved:
    the outputs show its whole state.
    """
    try:
        one = _candidate(instance, quantity, values, max_denominator)
        return None if one is None else _proved(instance, one)
    except HarnessError:
        instance.recreate()
        return None


def _candidate(
    instance: Instance, quantity: str, values: Mapping[str, float], max_denominator: int
) -> _Candidate | None:
    """Return the motion that a prediction belongs to, None where it cannot be proved."""
    names = (*DEVICE, "frequency_ratio", *PREDICTIONS)
    guessed = "load" if quantity == "blocking_force" else "initial_velocity"
    if guessed in values or any(name not in instance.fmu.variables for name in names):
        return None
    instance.start(values)
    with instance.explained():
        read = instance.read(names)
    count = common_period(read["frequency_ratio"], max_denominator)
    model = read["fidelity"], read["averaging_order"], read["friction_law"]
    if model != (2, 2, 0) or count is None or read["prediction_valid"] != 1.0:
        return None
    try:
        # Of the drive without its deviations: near enough as a start.
        device = Device.from_mapping({name: read[name] for name in DEVICE})
        displacement, force = steady_vibration(device)
        swing = force / (1j * device.drive_frequency * device.total_mass)
    except (ValueError, ArithmeticError):
        return None
    drive = device.drive_frequency * (1.0 + values.get("frequency_deviation", 0.0))
    velocity, prediction = read["steady_velocity"], read[quantity]
    if quantity == "blocking_force":
        values, velocity = {**values, "load": prediction}, 0.0
    size = (abs(swing), abs(displacement), abs(displacement) * drive)
    if 0.0 in size or not all(map(isfinite, (velocity, prediction, *size))):
        return None
    start = (velocity + swing.imag, displacement.imag, drive * displacement.real)
    period = count * tau / drive
    return _Candidate(prediction, values, velocity, period, np.array(start), np.array(size))


def _proved(instance: Instance, one: _Candidate) -> float | None:
    """Return the prediction if the motion that runs from its start have as their limit has it."""
    start, matrix = one.start, None
    for _ in range(1 + RESTARTS):
        run = _run(instance, one, start)
        if not np.isfinite(run).all() or run[-1, 4] >= 1.0:
            return None
        # State and mean velocity of successive common periods, over their scales.
        travel = np.diff(run[:, 3]) / one.period / one.scale[0]
        seen = np.column_stack([run[:-1, :3] / one.scale, travel])
        changes = np.diff(seen, axis=0).T
        if matrix is None:
            matrix = changes[:, 1:] @ np.linalg.pinv(changes[:, :-1], rcond=RANK)
            if np.abs(np.linalg.eigvals(matrix)).max() >= 1.0 - NEUTRAL:
                return None
        rest = np.linalg.solve(np.eye(4) - matrix, matrix @ changes[:, -1])
        limit = seen[-1] + rest
        error = abs(float(limit[3]) - one.velocity / float(one.scale[0]))
        if error <= PROVEN and np.abs(rest).max() <= NEAR:
            return one.prediction
        start = limit[:3] * one.scale
    return None


def _run(instance: Instance, one: _Candidate, start: Array) -> Array:
    """Return state, position and stick fraction after 0, 1, ... common periods, a row each."""
    instance.start({**one.values, **dict(zip(INITIAL, start.tolist(), strict=True))})
    block = instance.block(READ)
    with instance.explained():
        rows = [block.read()]
        for period in range(PERIODS):
            instance.step_to((period + 1) * one.period)
            rows.append(block.read())
    return np.array(rows)
