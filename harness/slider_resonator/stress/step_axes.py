"""The axes of stepping: sizes, start time, length and stored states."""

from __future__ import annotations

import random
from collections.abc import Iterator
from math import tau

from slider_resonator.stress.case import (
    CHEAP,
    MODELS,
    RESOLVED,
    Hold,
    Limit,
    MatrixCell,
    Model,
)
from slider_resonator.stress.device_axes import AMPLITUDE, W

STEP = "communication step"
PERIOD = tau / W
LATE = 1e12
"""A start time, s, at which time is known to 2^-13 s only."""
SMALLEST = 5e-324

PERIODS = {0: 1e8, 1: 1e5, 2: 1e5}
"""Drive periods of the longest runs with Coulomb friction, by fidelity."""
LUGRE_PERIODS = {0: 1e8, 1: 1e3, 2: 1e3}
"""The same with LuGre friction."""
LONG_PERIODS = {0: 1e8, 1: 1e6}
"""Drive periods of the resolved runs of `--long`, by friction law."""
STEADY = {2: 0.12666700, 1: 0.1266646, 0: 0.126731}
"""Steady velocity of table 1, m/s, by fidelity, found without long runs."""


def step_cells(*, long: bool) -> Iterator[MatrixCell]:
    """Yield the cells of all axes that are steps; `long` adds resolved runs of LONG_PERIODS."""
    for model in CHEAP:
        yield from _sizes(model)
    for model in MODELS:
        yield _late(model)
        yield from _restored(model)
        yield _many_periods(model, _periods(model))
    if long:
        for model in RESOLVED:
            yield _many_periods(model, LONG_PERIODS[model.friction_law])


def _sizes(model: Model) -> Iterator[MatrixCell]:
    draw = random.Random(3)
    logarithmic = tuple(Hold(10.0 ** draw.uniform(-12.0, -2.0)) for _ in range(100))
    alternating = tuple(Hold(10.0 * PERIOD if i % 2 else 1e-15) for i in range(40))
    denormal = tuple(Hold(SMALLEST if i % 2 else PERIOD / 7.0) for i in range(60))
    for decade in range(-12, 5):
        yield _size(model, decade)
    yield MatrixCell(STEP, "smallest denormal", model, {}, denormal)
    yield MatrixCell(STEP, "random, 1e-12 to 1e-2 s", model, {}, logarithmic)
    yield MatrixCell(STEP, "10 periods and 1e-15 s in turn", model, {}, alternating)


def _size(model: Model, decade: int) -> MatrixCell:
    """Steps of a power of ten, by a device so slow that they have 5600 periods at most."""
    slower = 10.0 ** min(max(decade + 1, 0), 3)
    slow = {
        "drive_frequency": W / slower,
        "resonator_frequency": W / slower,
        "base_amplitude": AMPLITUDE * slower,
    }
    count = 300 if decade < -4 else 20 if decade < 0 else 2 if decade < 4 else 1
    holds = (Hold(PERIOD * slower / 3.0), Hold(float(f"1e{decade}"), count))
    return MatrixCell(STEP, f"1e{decade} s", model, slow if slower > 1.0 else {}, holds)


def _late(model: Model) -> MatrixCell:
    """Steps that time can hold at 1e12 s: the motion is that from time 0."""
    holds = (Hold(2.0**-13, 300), Hold(2.0**-5, 3))
    return MatrixCell("start time", "1e12 s", model, {}, holds, start_time=LATE, from_zero=True)


def _restored(model: Model) -> Iterator[MatrixCell]:
    """A friction that holds the slider for part of each period."""
    sticking = {"friction_coefficient": 100.0, "normal_amplitude": 0.9}
    holds = (Hold(PERIOD / 16.0, 160),)
    yield MatrixCell("state restored", "mid-stick", model, sticking, holds, restored=True)
    yield MatrixCell("state restored", "table 1", model, {}, holds, restored=True)


def _periods(model: Model) -> float:
    return (LUGRE_PERIODS if model.friction_law else PERIODS)[model.fidelity]


def _many_periods(model: Model, periods: float) -> MatrixCell:
    limits: tuple[Limit, ...] = ()
    if model.friction_law == 0:
        why = "the steady motion, found without a long run, does not drift"
        exact = 2 if model.second_order else model.fidelity
        limits = (Limit("mean_velocity", STEADY[exact], 1e-6, why),)
    # In parts of up to 1e4 periods, one step each in the other partition: its work is bounded.
    parts = max(2, min(100, round(periods / 1e4)))
    holds = parts * (Hold(periods * PERIOD / (5 * parts), 5, phase=0.0),)
    return MatrixCell("drive periods", f"{periods:.0e}", model, {}, holds, limits=limits)
