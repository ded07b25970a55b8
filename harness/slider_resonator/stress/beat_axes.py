"""The axes of slow phases (beats, starts in flight, late jumps, neutral motions), and overflow."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import pi, tau

from slider_resonator.stress.case import MODELS, Hold, Limit, MatrixCell, Model
from slider_resonator.stress.device_axes import W, usual_holds

PERIOD = tau / W
DETUNING = 0.05
BEAT = PERIOD / DETUNING
WEAK = {"normal_preload": 0.01, "normal_amplitude": 0.01, "initial_velocity": -0.144}
"""Friction that needs many beats to change the slow velocity."""
FIRST_ORDER = (Model(0, 0), Model(0, 1))
"""Averages whose reference is one, too, and as cheap."""
BEATS = {"1 beat": 1.0, "90 beats": 90.0, "1/3 beat": 1.0 / 3.0}
FAR = {
    "friction_coefficient": (1e308, 1.7e308),
    "resonator_mass": (1e300,),
    "normal_preload": (1e308,),
    "bristle_stiffness": (1e300,),
    "drive_frequency": (1e200,),
    "initial_velocity": (1e308,),
}
"""Values of parameters that leave the range of numbers: to be refused, or carried out finitely."""


def beat_cells() -> Iterator[MatrixCell]:
    """Yield the cells of these axes, by all models."""
    for model in MODELS:
        yield from _beats(model)
        yield from _starts_in_flight(model)
        yield from _late_jumps(model)
        yield from _neutral(model)
        yield from _overflow(model)


def _beats(model: Model) -> Iterator[MatrixCell]:
    """Steps in all of whose stages the phase of the normal load is the same."""
    for value, beats in BEATS.items():
        limits: tuple[Limit, ...] = ()
        if model == Model(0, 0) and beats > 1.0:
            limits = (Limit("mean_velocity", -0.0984030, 1e-6, "by small steps"),)
        # Averages of second order resolve beats: more of them take more work than a step may.
        count = 8 if beats > 1.0 or model.second_order else 24
        size = min(beats, 90.0 if model.fidelity == 0 else 3.0) * BEAT
        hold = Hold(size, count, phase=0.5, frequency_ratio=1.0 + DETUNING)
        yield MatrixCell("beat against step", value, model, WEAK, (hold,), limits=limits)


def _starts_in_flight(model: Model) -> Iterator[MatrixCell]:
    """No friction at first, under a load that is slow itself."""
    parameters = {"normal_preload": 0.5}
    for ratio in (0.01, -0.003, 1e-6):
        limits: tuple[Limit, ...] = ()
        if model == Model(0, 0) and ratio == 0.01:
            limits = (Limit("mean_velocity", 0.0063860, 1e-7, "by small steps"),)
        periods = 1000.0 if model in FIRST_ORDER else 50.0 if model.second_order else 10.0
        size = periods * PERIOD
        hold = Hold(size, 3, phase=-pi / 2.0, frequency_ratio=ratio)
        yield MatrixCell(
            "start in flight", f"ratio {ratio:g}", model, parameters, (hold,), limits=limits
        )


def _late_jumps(model: Model) -> Iterator[MatrixCell]:
    """An input jumps once, long after the start, and never again."""
    periods = 400.0 if model in FIRST_ORDER else 40.0 if model.second_order else 10.0
    before = Hold(periods * PERIOD, 4)
    for name, value in (("phase", -2.0), ("load", 0.15), ("frequency_ratio", 3.0)):
        after = replace(before, size=before.size / 20.0, count=20, **{name: value})
        yield MatrixCell("late jump", name, model, {}, (before, after))


def _neutral(model: Model) -> Iterator[MatrixCell]:
    """Even ratios with flight while sliding turns: friction favours no velocity."""
    for ratio, amplitude, phase in ((2.0, 3.0, 0.3), (4.0, 3.0, 2.5)):
        parameters = {"normal_amplitude": amplitude}
        holds = tuple(
            replace(hold, frequency_ratio=ratio, phase=phase)
            for hold in usual_holds(model, parameters)
        )
        yield MatrixCell("neutral motions", f"ratio {ratio:g}", model, parameters, holds)


def _overflow(model: Model) -> Iterator[MatrixCell]:
    for name, values in FAR.items():
        for value in values:
            parameters = {name: value}
            text = f"{name} {value:g}"
            holds = usual_holds(model, {})
            yield MatrixCell("overflow", text, model, parameters, holds)
