"""The errors that come from holding inputs over a step, as they vary."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from slider_resonator.choosing.candidate import Model
from slider_resonator.choosing.errors import ErrorEstimate, Estimates
from slider_resonator.choosing.input_grid import inputs_as_they_vary, sampled_inputs
from slider_resonator.choosing.stretch import Stretch, follow
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene import Scene


def holding_errors(
    instance: Instance, scene: Scene, averaged: Model, duration: float, step: float
) -> dict[str, float]:
    """Return the errors that averaged motion makes by holding the inputs over each step (s)."""
    slow = averaged.parameters
    checkpoints = step * np.arange(1, int(duration / step))
    stretch = Stretch(0.0, duration, np.append(checkpoints[checkpoints < duration], duration))
    held = follow(instance, scene, slow, sampled_inputs(scene, duration, step), stretch)
    lines = instance.fmu.interpolates
    varying = inputs_as_they_vary(scene, duration, step / 4.0, interpolates=lines)
    meant = follow(instance, scene, slow, varying, stretch)
    apart = {name: np.abs(held[name] - meant[name]) for name in ("mean_velocity", "position")}
    return {
        "mean_velocity": float(apart["mean_velocity"][-1]),
        "velocity": float(apart["mean_velocity"].max()),
        "position": float(apart["position"].max()),
    }


def with_holding(estimates: Mapping[str, ErrorEstimate], added: Mapping[str, float]) -> Estimates:
    """Return errors with those of holding the inputs added."""
    return {
        name: replace(estimate, error=estimate.error + added.get(name, 0.0))
        for name, estimate in estimates.items()
    }
