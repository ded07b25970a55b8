"""Errors extrapolated from windows against runs of the whole scene."""

from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene import Scene
from slider_resonator.studies.choose.candidate import Candidate, Model
from slider_resonator.studies.choose.held_grid import averaged_inputs, sampled_inputs
from slider_resonator.studies.choose.probe import Probe
from slider_resonator.studies.choose.stretch import Stretch, follow
from slider_resonator.studies.choose.windows import SAFETY, holding_errors
from tests.harness.scene_text import scene_of

LONG = (
    "{device}[inputs]\nphase = 0.4\nload = {{ {load} }}\n"
    "[run]\nstop_time = 7.0\nsteps_per_period = 0.5\n"
    "[need]\nposition = {{ rel = 0.1 }}\nmean_velocity = {{ rel = 0.1 }}\n"
)


def errors_of_the_whole(instance: Instance, scene: Scene, model: Model) -> dict[str, float]:
    """Return the errors of averaged motion in the whole scene, which is resolved here."""
    duration = scene.stop_time or 0.0
    held = averaged_inputs(scene, duration, 0.01)
    stretch = Stretch(0.0, duration, scene.schedule().times[1:])
    law = {"friction_law": float(model.friction_law), "tolerance": 1e-12}
    found, true = (
        follow(instance, scene, {**law, "fidelity": fidelity}, held, stretch)
        for fidelity in (float(model.fidelity), 2.0)
    )
    return {
        "position": float(np.abs(found["position"] - true["position"]).max()),
        "mean_velocity": float(abs(found["mean_velocity"] - true["mean_velocity"])[-1]),
    }


@pytest.mark.parametrize("device", ["", "[device]\nfriction_law = 1\nbristle_stiffness = 1e4\n"])
@pytest.mark.parametrize(
    "load", ["constant = 0.03", "steps = [[0, 0], [3.1, 0.05]]", "ramp = [[0, 0], [5.0, 0.06]]"]
)
def test_errors_are_carried_through_a_long_scene(
    instance: Instance, device: str, load: str
) -> None:
    scene = scene_of(LONG.format(device=device, load=load))
    probe = Probe(instance, scene)
    assert probe.covers == "windows"
    model = Model(0, scene.device.friction_law)
    step = scene.step_size or 0.0
    estimates = probe.run_errors(Candidate(model, 1e-8, step / 64.0 if probe.varying else step))
    true = errors_of_the_whole(instance, scene, model)
    for name, error in true.items():
        assert estimates[name].error > 0.9 * error, f"{name} is worse than estimated"
        assert estimates[name].error < 2.0 * SAFETY * error, f"{name} is much better than estimated"


def test_holding_an_input_errs_in_proportion_to_the_step(instance: Instance) -> None:
    """A load that ramps at 0.02 N/s and is held for h pulls 0.01 h N too little on 1.1 kg."""
    text = LONG.format(device="", load="ramp = [[0, 0], [2.0, 0.04], [7.0, 0.04]]")
    scene = scene_of(text)
    coarse, fine = (holding_errors(instance, scene, 7.0, step)["position"] for step in (0.02, 0.01))
    assert coarse / fine == pytest.approx(2.0, rel=0.02)
    held, meant = (grid(scene, 7.0, 0.02) for grid in (sampled_inputs, averaged_inputs))
    impulses = [np.diff(g.times, append=7.0) @ g.values[:, 1] for g in (held, meant)]
    assert impulses[1] - impulses[0] == pytest.approx(0.04 * 0.01, rel=1e-2)
