"""Steady velocities and blocking forces that an FMU predicts, proved by its own motion.

An FMU with `averaging_order` 2 finds the periodic motion itself. To prove what it says, some common
periods are run from the vibration without friction on, at the mean velocity in question. Near a
periodic motion the map of a period is linear: its matrix follows from the changes over successive
periods (dynamic mode decomposition), and the limit of the sequence from the matrix. From there the
next run begins, and improves the matrix: where friction changes the velocity slowly, one run alone
tells little of it. The mean velocity of the limit must be the one that was predicted, and the
motion must be stable.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import isfinite, nan, tau

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import common_period
from slider_resonator.device.interface import INPUTS, PARAMETERS
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.equivalent_force import steady_vibration
from slider_resonator.steady.shooting import NEUTRAL, STATE

PERIODS = 4
"""Common periods of a run: as many changes of the state tell what becomes of three of them."""
PROVEN = 1e-8
"""Largest error of the mean velocity, in units of the amplitude of the vibration."""
NEAR = 1e-3
"""Largest distance from the limit, in units of the vibration: the map is linear to its square."""


@dataclass(frozen=True)
class _Candidate:
    """A prediction of the point `index` and the motion that belongs to it.

    `start` and `scale` are those of velocity and resonator, `period` (s) is the common period,
    `velocity` (m/s) the mean velocity that the motion must have.
    """

    index: int
    prediction: float
    values: Mapping[str, float]
    velocity: float
    period: float
    start: tuple[float, ...]
    scale: tuple[float, ...]


def proved_predictions(
    instance: Instance, quantity: str, points: Sequence[Mapping[str, float]], max_denominator: int
) -> list[float | None]:
    """Return the steady velocities or blocking forces that the FMU predicts at points.

    None stands for one that could not be proved. `points` are parameters and inputs by name. Only
    Coulomb friction of the full device is proved: the outputs show its whole state.
    """
    proved: list[float | None] = [None] * len(points)
    if not instance.fmu.has_orders:
        return proved
    try:
        instance.start({})
        with instance.explained():
            starts = instance.read([*PARAMETERS, "frequency_ratio"])
    except HarnessError:
        instance.recreate()
        return proved
    left = [
        candidate
        for index, point in enumerate(points)
        if (candidate := _candidate(instance, quantity, index, point, starts, max_denominator))
    ]
    before: Array | None = None
    for _ in range(5):  # each further run begins at the limit of the one before
        runs = np.array([_run(instance, one) for one in left]).reshape(-1, PERIODS + 1, 5)
        good = np.isfinite(runs).all(axis=(1, 2)) & (runs[:, -1, 4] < 1.0)
        left = [one for one, is_good in zip(left, good, strict=True) if is_good]
        seen = _seen(left, runs[good])
        if before is None:
            matrices = _matrices(seen)
        else:
            matrices = _improved(matrices[good], before[good], seen)
        rest = _rest(matrices, seen)
        limits = seen[:, -1] + rest
        aim = np.array([one.velocity / one.scale[0] for one in left])
        is_proved = (np.abs(limits[:, 3] - aim) <= PROVEN) & (np.abs(rest).max(axis=1) <= NEAR)
        multipliers = np.linalg.eigvals(matrices[:, :3])
        is_proved &= np.abs(multipliers).max(axis=1, initial=0.0) < 1.0 - NEUTRAL
        further = []
        for one, limit, is_done in zip(left, limits, is_proved, strict=True):
            if is_done:
                proved[one.index] = one.prediction
            else:
                further.append(replace(one, start=tuple((limit[:3] * one.scale).tolist())))
        left, matrices, before = further, matrices[~is_proved], seen[~is_proved]
    return proved


def _candidate(
    instance: Instance,
    quantity: str,
    index: int,
    values: Mapping[str, float],
    starts: Mapping[str, float],
    max_denominator: int,
) -> _Candidate | None:
    """Return the motion that a prediction belongs to, None where it cannot be proved.

    `starts` are the parameters and the frequency ratio that a point does not say.
    """
    device = {**starts, **values}
    count = common_period(device["frequency_ratio"], max_denominator)
    is_full = device["fidelity"] == 2 and device["averaging_order"] == 2
    if not is_full or device["friction_law"] or "initial_velocity" in values or count is None:
        return None
    try:
        instance.start(values)
        with instance.explained():
            prediction = instance.value(quantity)
    except HarnessError:
        instance.recreate()
        return None
    parameters = tuple(one for one in device.items() if one[0] not in INPUTS)
    displacement, swing = _vibration(parameters)
    drive = device["drive_frequency"] * (1.0 + values.get("frequency_deviation", 0.0))
    size = (abs(swing), abs(displacement), abs(displacement) * drive)
    if 0.0 in size or not all(map(isfinite, (prediction, *size))):
        return None
    velocity = prediction
    if quantity == "blocking_force":
        values, velocity = {**values, "load": prediction}, 0.0
    start = (velocity + swing.imag, displacement.imag, drive * displacement.real)
    return _Candidate(index, prediction, values, velocity, count * tau / drive, start, size)


@lru_cache  # points of a sweep often differ by inputs alone
def _vibration(parameters: tuple[tuple[str, float], ...]) -> tuple[complex, complex]:
    """Return the complex amplitudes of resonator displacement (m) and slider velocity (m/s).

    Those of the steady vibration without friction; 0 where there is none.
    """
    device = Device.from_mapping(dict(parameters))
    try:
        displacement, force = steady_vibration(device)
        return displacement, force / (1j * device.drive_frequency * device.total_mass)
    except (HarnessError, ValueError, ArithmeticError):
        return 0j, 0j


def _run(instance: Instance, one: _Candidate) -> list[list[float]]:
    """Return state, position and stick fraction after 0, 1, ... common periods, nan on an error."""
    initial = {f"initial_{name}": value for name, value in zip(STATE[:3], one.start, strict=True)}
    block = instance.block((*STATE[:3], "position", "stick_fraction"))
    try:
        with instance.explained():
            instance.initialise({**one.values, **initial})
            instance.begin()
            rows = [block.read()]
            for period in range(PERIODS):
                instance.step_to((period + 1) * one.period)
                rows.append(block.read())
    except HarnessError:
        instance.recreate()
        return [[nan] * 5] * (PERIODS + 1)
    return rows


def _seen(candidates: Sequence[_Candidate], runs: Array) -> Array:
    """Return state after each period and mean velocity over it (n, PERIODS + 1, 4), over scales.

    `runs` (n, PERIODS + 1, 5) are those of `_run`.
    """
    scale = np.array([one.scale for one in candidates]).reshape(-1, 1, 3)
    travel = np.diff(runs[:, :, 3:4], axis=1, prepend=runs[:, :1, 3:4])
    period = np.array([one.period for one in candidates]).reshape(-1, 1, 1)
    return np.concatenate([runs[:, :, :3] / scale, travel / period / scale[:, :, :1]], axis=2)


def _matrices(seen: Array) -> Array:
    """Return the matrices (n, 4, 3) from a change of state to what a period makes of it."""
    changes = np.swapaxes(np.diff(seen, axis=1), 1, 2)
    inverse = np.linalg.pinv(changes[:, :3, :-1], rcond=1e-9)
    return np.asarray(changes[:, :, 1:] @ inverse, dtype=np.float64)


def _improved(matrices: Array, before: Array, seen: Array) -> Array:
    """Return matrices that also map the difference of two runs (Broyden's update, 1965).

    The state before the last period of the former run and the first of the next one are close to
    each other. Where they are so far apart that numbers end, matrices stay.
    """
    change = seen[:, 0, :3] - before[:, -2, :3]
    missing = seen[:, 1] - before[:, -1] - (matrices @ change[:, :, None])[:, :, 0]
    size = np.maximum(np.sum(change**2, axis=1), np.finfo(np.float64).tiny)
    improved = matrices + missing[:, :, None] * (change / size[:, None])[:, None, :]
    is_finite = np.isfinite(improved).all(axis=(1, 2), keepdims=True)
    return np.asarray(np.where(is_finite, improved, matrices))


def _rest(matrices: Array, seen: Array) -> Array:
    """Return what is missing to the limits (n, 4) after runs (n, PERIODS + 1, 4)."""
    change = seen[:, -1, :3] - seen[:, -2, :3]
    before = np.linalg.pinv(np.eye(3) - matrices[:, :3]) @ change[:, :, None]
    return np.asarray((matrices @ before)[:, :, 0], dtype=np.float64)
