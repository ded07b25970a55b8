"""The axis of events that graze, coincide, or stand exactly at their limit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import nextafter, pi

from slider_resonator.stress.case import CHEAP, COULOMB_RESOLVED, Limit, MatrixCell, Model
from slider_resonator.stress.device_axes import usual_holds

LIMIT = 2 * 0.1 * 1.0
"""Friction of table 1 at a constant load of 1 N, N."""
AROUND = {"below": nextafter(LIMIT, 0.0), "at": LIMIT, "above": nextafter(LIMIT, 1.0)}
"""The limit and the numbers next to it."""

Parameters = Mapping[str, float]


def event_cells() -> Iterator[MatrixCell]:
    """Yield the cells at limits of events, by all models."""
    for model in CHEAP:
        yield from _grazing(model)
        yield from _simultaneous(model)
        yield from _free(model)


def _grazing(model: Model) -> Iterator[MatrixCell]:
    """A direct drive whose peak just reaches what friction holds, at a constant load."""
    for text, force in AROUND.items():
        parameters = {"base_amplitude": 0.0, "normal_amplitude": 0.0, "tangential_force": force}
        limits: tuple[Limit, ...] = ()
        if model in COULOMB_RESOLVED and model.fidelity == 2:
            why = "friction holds a force up to its limit"
            limits = (Limit("position", 0.0, 1e-18, why), Limit("velocity", 0.0, 1e-12, why))
        yield _cell("grazing release", f"peak {text} the limit", model, parameters, limits=limits)
    yield _cell("grazing release", "load lifts in a point", model, {}, -pi / 2.0)


def _simultaneous(model: Model) -> Iterator[MatrixCell]:
    """Drive and friction limit rise together from a touchdown; lift-off meets release."""
    for text, force in AROUND.items():
        parameters = {"base_amplitude": 0.0, "normal_preload": 0.0, "tangential_force": force}
        yield _cell("simultaneous", f"drive {text} the limit all along", model, parameters)
    touching = {"base_amplitude": 0.0, "tangential_force": LIMIT}
    yield _cell("simultaneous", "drive peaks where the load vanishes", model, touching, pi)
    lifting = {**touching, "normal_amplitude": 2.0}
    yield _cell("simultaneous", "drive peaks in flight", model, lifting, pi)
    still = {"base_amplitude": 0.0, "normal_preload": 0.0, "normal_amplitude": 0.0}
    yield _cell("simultaneous", "no force at all", model, still)


def _free(model: Model) -> Iterator[MatrixCell]:
    """No drive: the energy of the ringing resonator and the slider can only fall."""
    ringing = {"base_amplitude": 0.0, "initial_resonator_displacement": 1e-4}
    undamped = {**ringing, "damping_ratio": 0.0}
    for value, parameters in (
        ("xi 0.05", ringing),
        ("xi 0", undamped),
        ("xi 0, mu 0", {**undamped, "friction_coefficient": 0.0}),
        ("slides to rest", {"base_amplitude": 0.0, "initial_velocity": 0.01}),
    ):
        yield _cell("free ringing", value, model, parameters)


def _cell(
    axis: str,
    value: str,
    model: Model,
    parameters: Parameters,
    phase: float = 0.0,
    limits: tuple[Limit, ...] = (),
) -> MatrixCell:
    holds = tuple(replace(h, phase=phase) for h in usual_holds(model, parameters))
    return MatrixCell(axis, value, model, parameters, holds, limits=limits)
