"""Scenes whose cheapest model a wrong cost once hid, or that were not chosen for at all.

What is cheapest was found by the CPU time of the native FMU for each candidate that meets the need.
"""

from __future__ import annotations

import pytest

from slider_resonator.choosing.choosing import choose_with
from slider_resonator.fmu.instance import Instance
from tests.harness.choosing.judging import described, judge
from tests.harness.scene_text import scene_of

ALTERNATING = ", ".join(f"[{0.18 * i:.2f}, {i % 2}.0]" for i in range(60))
SCENES = {
    "phases that alternate": (
        f"[inputs]\nphase = {{ steps = [{ALTERNATING}] }}\n"
        "[run]\nstop_time = 10.8\nstep_size = 0.01\n[need]\nmean_velocity = { rel = 1e-4 }\n",
        (0, 2, 0),
    ),
    "leaps in flight": (
        "[device]\nnormal_amplitude = 1.8\n[inputs]\nphase = 0.3\n"
        "[run]\nstop_time = 12.0\nstep_size = 0.05\n[need]\nposition = { rel = 1e-4 }\n",
        (0, 2, 0),
    ),
    "stiff bristles in a long run": (
        "[device]\nfriction_law = 1\nbristle_stiffness = 1e6\n[inputs]\nphase = 0.2\n"
        "[run]\nstop_time = 2.0\nstep_size = 0.05\n"
        '[need]\nmean_velocity = { rel = 1e-4 }\nfriction_law = "free"\n',
        (0, 2, 1),
    ),
    "a chirp that is passed on": (
        "[inputs]\nfrequency_ratio = { ramp = [[0, 1], [5, 1.02]] }\n"
        "[run]\nstop_time = 5.0\nstep_size = 0.01\ninterpolate = true\n"
        "[need]\nmean_velocity = { rel = 0.01 }\n",
        (0, 1, 0),
    ),
    "bristles under a load that is passed on": (
        "[device]\nfriction_law = 1\nbristle_stiffness = 1e4\n"
        "[inputs]\nload = { ramp = [[0, 0], [3, 0.05]] }\n"
        "[run]\nstop_time = 4.0\nstep_size = 0.02\ninterpolate = true\n"
        "[need]\nmean_velocity = { rel = 1e-5 }\n",
        (0, 2, 1),
    ),
    "a preload that is tuned in many steps": (
        "[run]\nstop_time = 4.0\nstep_size = 0.01\n[need]\nposition = { rel = 0.01 }\n"
        "[tuning]\nnormal_preload = { ramp = [[0, 1.0], [4, 1.5]] }\n",
        (0, 1, 0),
    ),
}
"""Fidelity, averaging order and friction law that are the cheapest by measurement."""


@pytest.mark.parametrize("name", SCENES)
def test_the_model_that_measures_as_cheapest_is_chosen(instance: Instance, name: str) -> None:
    text, expected = SCENES[name]
    scene = scene_of(text)
    choice = choose_with(instance, scene)
    assert choice.meets
    assert (choice.fidelity, choice.averaging_order, choice.friction_law) == expected
    verdict = judge(instance, scene, choice)
    assert verdict.met, described(verdict, name)
