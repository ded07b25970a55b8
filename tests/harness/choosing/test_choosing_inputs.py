"""Choices for scenes with inputs and parameters that change, or steps of their own."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.choosing import choose
from slider_resonator.choosing.choosing import choose_with
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from tests.harness.scene_text import scene_of

pytestmark = pytest.mark.usefixtures("stated_costs")


def test_inputs_that_vary_are_sampled_as_often_as_the_need_is_tight(instance: Instance) -> None:
    """Holding an input errs in proportion to the step, and the steps go by powers of two."""
    text = (
        "[inputs]\nload = { ramp = [[0, 0], [0.1, 0.1]] }\n[run]\nstop_time = 0.1\n"
        "step_size = 0.02\n[need]\nposition = { rel = %g }\n"
    )
    loose, tight = (choose_with(instance, scene_of(text % need)) for need in (1e-3, 1e-4))
    assert loose.meets
    assert tight.meets
    assert loose.step is not None
    assert tight.step is not None
    assert loose.step / tight.step in (8.0, 16.0)


RAMPED = (
    "[inputs]\nload = { ramp = [[0, 0], [0.6, 0.04], [1.0, 0]] }\n"
    "phase = { ramp = [[0, 0.2], [1.0, 0.7]] }\n"
    "[run]\nstop_time = 1.0\nstep_size = 0.01\ninterpolate = %s\n"
    "[need]\nmean_velocity = { rel = 1e-7 }\n"
)


def test_straight_lines_that_are_passed_on_need_no_small_steps(instance: Instance) -> None:
    """Held, they err by the step; passed on, they are exact in a step of any length."""
    held, passed = (choose_with(instance, scene_of(RAMPED % says)) for says in ("false", "true"))
    assert (held.meets, held.inputs) == (False, "held")
    assert (passed.meets, passed.inputs, passed.step) == (True, "interpolated", 1.0)
    assert "interpolate = true" in " ".join(held.sentences())
    assert "inputs go on as straight lines" in " ".join(passed.sentences())


def test_a_choice_with_straight_lines_holds_in_the_run_that_applies_it(instance: Instance) -> None:
    scene = scene_of(RAMPED % "true")
    choice = choose_with(instance, scene)
    applied = choice.applied_to(scene)
    fine = scene.with_step(1e-3).with_values({"fidelity": 2.0})
    found, expected = (
        run(instance, one.parameters, one.schedule()).final("mean_velocity")
        for one in (applied, fine)
    )
    assert abs(found - expected) <= choice.allowed["mean_velocity"]


@pytest.mark.slow
def test_an_fmu_that_takes_no_derivatives_has_straight_lines_held(python_fmu: Path) -> None:
    text = (RAMPED % "true").replace("1e-7", "0.2").replace("stop_time = 1.0", "stop_time = 0.1")
    choice = choose(scene_of(text), python_fmu)
    assert (choice.meets, choice.inputs) == (True, "cannot")
    assert "canInterpolateInputs = false" in " ".join(choice.sentences())


def test_parameters_that_change_in_the_run_are_followed(instance: Instance) -> None:
    """Friction that doubles for the second half brings the slider nearer to its steady motion."""
    choices = [
        choose_with(
            instance,
            scene_of(
                "[run]\nstop_time = 2.0\nstep_size = 0.02\n[need]\n"
                f"mean_velocity = {{ rel = 1e-3 }}\n[tuning]\n"
                f"friction_coefficient = {{ steps = [[0, 0.1], [1.0, {late}]] }}\n"
            ),
        )
        for late in (0.1, 0.2)
    ]
    assert all(choice.meets for choice in choices)
    constant, doubled = (choice.allowed["mean_velocity"] for choice in choices)
    assert doubled > 1.05 * constant


def test_a_run_that_starts_later_or_in_unequal_steps_has_a_choice(instance: Instance) -> None:
    text = "[run]\nstop_time = 0.5\n{}\n[need]\nposition = {{ rel = 0.05 }}\n"
    plain, later, unequal = (
        choose_with(instance, scene_of(text.format(how)))
        for how in (
            "step_size = 0.01",
            "step_size = 0.01\nstart_time = 100.0",
            "step_sizes = [0.001, 0.01]",
        )
    )
    assert plain.meets
    for choice in (later, unequal):
        assert choice.meets, "models of nearly equal cost may change places"


def test_inputs_that_jump_need_no_small_steps(instance: Instance) -> None:
    scene = scene_of(
        "[inputs]\nload = { steps = [[0, 0], [0.0711, 0.05]] }\n[run]\nstop_time = 0.2\n"
        "step_size = 0.02\n[need]\nposition = { rel = 1e-9 }\n",
    )
    choice = choose_with(instance, scene)
    assert (choice.meets, choice.step) == (True, 0.02)
    assert 0.0711 in choice.applied_to(scene).schedule().times
