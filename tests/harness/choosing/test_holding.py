"""The error of holding an input over a step."""

from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.choosing.candidate import Model
from slider_resonator.choosing.holding import holding_errors
from slider_resonator.choosing.input_grid import inputs_as_they_vary, sampled_inputs
from slider_resonator.fmu.instance import Instance
from tests.harness.scene_text import scene_of

SCENE = "[inputs]\nload = { ramp = [[0, 0], [2.0, 0.04], [7.0, 0.04]] }\n"


def test_holding_an_input_errs_in_proportion_to_the_step(instance: Instance) -> None:
    """A load that ramps at 0.02 N/s and is held for h pulls 0.01 h N too little on 1.1 kg."""
    scene = scene_of(SCENE)
    coarse, fine = (
        holding_errors(instance, scene, Model(0, 0, 1), 7.0, step)["position"]
        for step in (0.02, 0.01)
    )
    assert coarse / fine == pytest.approx(2.0, rel=0.02)
    held = sampled_inputs(scene, 7.0, 0.02)
    meant = inputs_as_they_vary(scene, 7.0, 0.02, interpolates=False)
    impulses = [np.diff(g.times, append=7.0) @ g.values[:, 1] for g in (held, meant)]
    assert impulses[1] - impulses[0] == pytest.approx(0.04 * 0.01, rel=1e-2)
