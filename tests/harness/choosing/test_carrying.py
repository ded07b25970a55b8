"""Errors extrapolated from windows against runs of the whole scene."""

from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.choosing import coverage
from slider_resonator.choosing.candidate import Candidate, Model
from slider_resonator.choosing.carrying import SAFETY
from slider_resonator.choosing.input_grid import inputs_as_they_vary
from slider_resonator.choosing.probe import Probe
from slider_resonator.choosing.stretch import Stretch, follow
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene import Scene
from tests.harness.scene_text import scene_of

LONG = (
    "{device}[inputs]\nphase = 0.4\nload = {{ {load} }}\n"
    "[run]\nstop_time = 14.0\nsteps_per_period = 0.5\n"
    "[need]\nposition = {{ rel = 0.1 }}\nmean_velocity = {{ rel = 0.1 }}\n"
)


@pytest.fixture(autouse=True)
def _not_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lay windows in scenes that are short enough to be run as a whole here."""
    monkeypatch.setattr(coverage, "SHORT", 0.0)


def errors_of_the_whole(instance: Instance, scene: Scene, model: Model) -> dict[str, float]:
    """Return the errors of averaged motion in the whole scene, which is resolved here."""
    duration = scene.stop_time or 0.0
    held = inputs_as_they_vary(scene, duration, 0.01, interpolates=False)
    stretch = Stretch(0.0, duration, scene.schedule().times[1:])
    found, true = (
        follow(instance, scene, {**one.parameters, "tolerance": 1e-12}, held, stretch)
        for one in (model, Model(2, model.friction_law))
    )
    return {
        "position": float(np.abs(found["position"] - true["position"]).max()),
        "mean_velocity": float(abs(found["mean_velocity"] - true["mean_velocity"])[-1]),
    }


@pytest.mark.parametrize("device", ["", "[device]\nfriction_law = 1\nbristle_stiffness = 1e4\n"])
@pytest.mark.parametrize(
    "load",
    [
        "constant = 0.03",
        "steps = [[0, 0], [3.1, 0.05]]",
        "steps = [[0, 0], [13.93, 0.1]]",
        "steps = [[0, 0], [2.9, 0.1], [3.0, -0.1], [12.0, 0.3]]",
        "ramp = [[0, 0], [5.0, 0.06]]",
    ],
)
def test_errors_are_carried_through_a_long_scene(
    instance: Instance, device: str, load: str
) -> None:
    scene = scene_of(LONG.format(device=device, load=load))
    probe = Probe(instance, scene)
    assert probe.covers == "windows"
    model = Model(0, scene.device.friction_law, 1)
    step = scene.step_size or 0.0
    estimates = probe.run_errors(Candidate(model, 1e-8, step / 64.0 if probe.varying else step))
    true = errors_of_the_whole(instance, scene, model)
    for name, error in true.items():
        assert estimates[name].error > 0.9 * error, f"{name} is worse than estimated"
        assert estimates[name].error < 2.0 * SAFETY * error, f"{name} is much better than estimated"


def test_a_late_jump_of_the_phase_kicks_the_slow_velocity(instance: Instance) -> None:
    """Averaged motion goes on, while the full device takes the kick over: a window shows it."""
    calm = LONG.format(device="", load="constant = 0.0")
    late = calm.replace("phase = 0.4", "phase = { steps = [[0, 0.4], [13.9, 2.7]] }")
    model = Model(0, 0, 1)
    without, true = (
        errors_of_the_whole(instance, scene_of(text), model)["mean_velocity"]
        for text in (calm, late)
    )
    assert true > 3.0 * without
    scene = scene_of(late)
    probe = Probe(instance, scene)
    assert probe.covers == "windows"
    estimate = probe.run_errors(Candidate(model, 1e-8, scene.step_size))["mean_velocity"]
    assert estimate.error == pytest.approx(SAFETY * true, rel=0.05)


def test_a_mean_velocity_near_zero_is_not_as_large_as_averaging_leaves_it(
    instance: Instance,
) -> None:
    """At phase - theta1 = 0 averaged motion stops; the full device creeps on."""
    scene = scene_of(
        "[device]\nfriction_coefficient = 1.0\n[inputs]\nphase = -0.733313\n"
        "[run]\nstop_time = 14.0\nsteps_per_period = 1\n[need]\nmean_velocity = { rel = 0.1 }\n"
    )
    probe = Probe(instance, scene)
    assert probe.covers == "windows"
    size = probe.run_errors(Candidate(Model(2, 0), 1e-8, scene.step_size))["mean_velocity"]
    held = inputs_as_they_vary(scene, 14.0, 1.0, interpolates=False)
    whole = follow(instance, scene, {"fidelity": 2.0}, held, Stretch(0.0, 14.0, np.array([14.0])))
    true = abs(float(whole["mean_velocity"][-1]))
    averaged = follow(
        *(instance, scene, Model(0, 0, 1).parameters, held),
        Stretch(0.0, 14.0, np.array([14.0])),
    )
    assert abs(float(averaged["mean_velocity"][-1])) < 0.1 * true
    assert size.magnitude == pytest.approx(true, rel=0.1)
