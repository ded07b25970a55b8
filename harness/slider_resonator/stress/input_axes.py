"""The axes that are inputs: frequency ratio, load, and inputs that jump at every step."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from math import pi, sqrt, tau

from slider_resonator.device.device import Device
from slider_resonator.references.closed_forms import device_blocking_force
from slider_resonator.stress.case import (
    COULOMB_RESOLVED,
    MODELS,
    Hold,
    Limit,
    MatrixCell,
    Model,
)
from slider_resonator.stress.device_axes import NEAR_ONE, W, usual_holds

PERIOD = tau / W
PHASE = 0.4
AROUND_ONE = {"1 - 1e-12": 1.0 - NEAR_ONE, "1": 1.0, "1 + 1e-12": 1.0 + NEAR_ONE}
RATIOS = {
    **{"0": 0.0, "1e-6": 1e-6, "1 - 1e-12": 1.0 - NEAR_ONE, "1 + 1e-12": 1.0 + NEAR_ONE},
    **{"100": 100.0, "-1": -1.0, "pi": pi, "2^(1/2)": sqrt(2.0)},
}
STEPS = 150
"""Steps of a run whose inputs change at each of them."""


def input_cells() -> Iterator[MatrixCell]:
    """Yield the cells of all axes that are inputs."""
    for model in MODELS:
        yield from _ratios(model)
        yield from _blocking_loads(model)
        yield from _full_friction(model)
        yield from _jumps(model)


def _ratios(model: Model) -> Iterator[MatrixCell]:
    for text, ratio in RATIOS.items():
        holds = tuple(replace(h, frequency_ratio=ratio) for h in usual_holds(model, {}))
        yield MatrixCell("frequency ratio", text, model, {}, holds)
    draw = random.Random(1)
    size = _size(model)
    changing = tuple(Hold(size, frequency_ratio=draw.uniform(-3.0, 3.0)) for _ in range(STEPS))
    yield MatrixCell("frequency ratio", "changes every step", model, {}, changing)


def _blocking_loads(model: Model) -> Iterator[MatrixCell]:
    blocking = device_blocking_force(Device(), PHASE)
    limits: tuple[Limit, ...] = ()
    if model == Model(0, 0):
        limits = (Limit("mean_velocity", 0.0, 1e-7, "(22): the averaged slider stands"),)
    for text, share in AROUND_ONE.items():
        usual = (Hold(500.0 * PERIOD, 100),) if limits else usual_holds(model, {})
        holds = tuple(replace(h, load=blocking * share) for h in usual)
        yield MatrixCell("blocking load", text, model, {}, holds, limits=limits)


def _full_friction(model: Model) -> Iterator[MatrixCell]:
    """A load as great as the friction of a slider without drive: it must not move below that."""
    parameters = {"base_amplitude": 0.0, "normal_amplitude": 0.0}
    device = Device()
    limit = device.friction_faces * device.friction_coefficient * device.normal_preload
    for text, share in AROUND_ONE.items():
        limits = []
        if model in COULOMB_RESOLVED:
            mode = float(share > 1.0)
            limits.append(Limit("contact_mode", mode, 0.0, "slips only above full friction"))
        if model.friction_law == 0:
            holds = usual_holds(model, {})
            impulse = limit * max(0.0, share - 1.0) * holds[0].size * holds[0].count
            allowed = 2.0 * impulse / device.slider_mass
            limits.append(Limit("velocity", 0.0, allowed, "excess force times time over mass"))
        holds = tuple(replace(h, load=-limit * share) for h in usual_holds(model, {}))
        yield MatrixCell(
            "load at full friction", text, model, parameters, holds, limits=tuple(limits)
        )


def _jumps(model: Model) -> Iterator[MatrixCell]:
    for seed in (1, 2):
        draw = random.Random(seed)
        holds = tuple(
            Hold(
                _size(model),
                phase=draw.uniform(-10.0, 10.0),
                load=draw.uniform(-0.2, 0.2),
                frequency_ratio=draw.choice((0.0, 1.0, -1.0, 2.0, 3.0, draw.uniform(-5.0, 5.0))),
            )
            for _ in range(STEPS)
        )
        yield MatrixCell("inputs jump every step", f"seed {seed}", model, {}, holds)


def _size(model: Model) -> float:
    return 3.7 * PERIOD if model.fidelity == 0 else 0.137 * PERIOD
