"""Choices for scenes whose answer follows from physics."""

from pathlib import Path

import pytest

from slider_resonator.choosing.choice import Candidate
from slider_resonator.choosing.choosing import Evaluation, cheapest, choose, choose_with
from slider_resonator.choosing.probe import Probe
from slider_resonator.device.model import Model
from slider_resonator.fmu.instance import Instance
from tests.harness.scene_text import scene_of, table_1

pytestmark = pytest.mark.usefixtures("stated_costs")


def test_events_rule_averaged_motion_out_unprobed(instance: Instance) -> None:
    scene = table_1("event_times = { abs = 1e-7 }", periods=50.0, steps=8.0)
    choice = choose_with(instance, scene)
    assert (choice.meets, choice.fidelity, choice.step) == (True, 2, scene.step_size)
    assert {m.fidelity: m.why for m in choice.ruled_out}[0] == "averaged motion has no events"


def test_steady_needs_choose_between_theory_and_shooting(instance: Instance) -> None:
    loose = choose_with(instance, scene_of("[need]\nsteady_velocity = { rel = 0.01 }\n"))
    tight = choose_with(instance, scene_of("[need]\nsteady_velocity = { rel = 1e-7 }\n"))
    assert (loose.meets, loose.fidelity, loose.step) == (True, 0, None)
    assert (loose.averaging_order, tight.averaging_order) == (1, 2)
    assert (tight.meets, tight.fidelity, tight.step) == (True, 0, None), "by the period map: exact"


@pytest.mark.parametrize(
    ("inputs", "need", "message"),
    [
        ("load = 1.0", "steady_velocity", "load_above_friction"),
        ("", "beat", "no beat at frequency_ratio = 1: must be within 0.1 of an integer, but not"),
        ("frequency_ratio = 1.5", "beat", "no beat at frequency_ratio = 1.5: must be within 0.1"),
        ("frequency_ratio = 1.001", "beat", "0.15 beats"),
        ("frequency_ratio = 1.02\namplitude_deviation = -1.0", "beat", "does not oscillate"),
    ],
)
def test_quantity_without_a_value(instance: Instance, inputs: str, need: str, message: str) -> None:
    run = "[run]\ndrive_periods = 300\nsteps_per_period = 1\n" if need == "beat" else ""
    scene = scene_of(f"[inputs]\n{inputs}\n{run}[need]\n{need} = {{ rel = 0.1 }}\n")
    choice = choose_with(instance, scene)
    assert not choice.meets
    assert choice.reason.startswith(f"no model can: the resolved motion gives no {need}: ")
    assert message in choice.reason
    assert len(choice.ruled_out) == 4


def test_no_model_takes_steps_that_an_fmu_refuses(instance: Instance) -> None:
    """One of 150 s takes more work than an FMU may do in a step."""
    run = "[run]\nstop_time = 150.0\nsteps_per_period = 1e-5\n[need]\n"
    none = choose_with(
        instance,
        scene_of(
            f"[inputs]\nfrequency_ratio = 1.0001\n{run}"
            "mean_velocity = { rel = 0.01 }\nsteady_velocity = { rel = 0.01 }\n"
        ),
    )
    assert not none.meets
    assert "slow_beat" in none.reason
    exact = choose_with(instance, scene_of(f"{run}position = {{ rel = 1e-11 }}\n"))
    assert exact.meets, exact.reason


def test_a_long_scene_is_not_resolved_as_a_whole(instance: Instance) -> None:
    """Half an hour: a million drive periods, of which some thousand are enough."""
    late = "[inputs]\nload = { steps = [[0, 0], [1799.9, 0.1]] }\n"
    run = "[run]\nstop_time = 1800.0\nsteps_per_period = 0.001\n"
    need = "[need]\nmean_velocity = { rel = 0.01 }\n"
    steady, jump = (choose_with(instance, scene_of(f"{text}{run}{need}")) for text in ("", late))
    for choice in (steady, jump):
        assert (choice.meets, choice.fidelity, choice.probe) == (True, 0, "leaps")
        assert choice.probe_drive_periods < 10_000
    assert steady.error["mean_velocity"] == pytest.approx(6.4e-5, rel=0.3)
    assert jump.allowed["mean_velocity"] < 0.99 * steady.allowed["mean_velocity"]


def test_of_equal_costs_the_model_that_leaves_out_least_is_taken() -> None:
    def evaluation(model: Model, tolerance: float, cost: float) -> Evaluation:
        return Evaluation(Candidate(model, tolerance, 1.0), {}, {}, cost)

    averages, expensive = evaluation(Model(0, 0, 1), 1e-8, 1.0), evaluation(Model(2, 0), 1e-8, 1.06)
    fine, rough = (evaluation(Model(0, 0, 2), tolerance, 1.02) for tolerance in (1e-6, 1e-4))
    assert cheapest([averages, expensive]) is averages
    assert cheapest([averages, fine, rough, expensive]) is rough
    resolved = evaluation(Model(2, 0), 1e-8, 1.04)
    assert cheapest([averages, rough, resolved]) is resolved


def test_the_mean_velocity_can_be_needed_throughout(instance: Instance) -> None:
    """Averaged motion from rest is farther off in the transient than at the end."""
    need = "mean_velocity = { abs = 1e-2 }\nmean_velocity_throughout = { abs = 1e-2 }"
    scene = table_1(need, periods=8000.0, steps=0.01)
    averaged = Candidate(Model(0, 0, 1), 1e-8, scene.step_size)
    errors = Probe(instance, scene).measure(averaged)[0]
    end, throughout = (errors[f"mean_velocity{part}"].error for part in ("", "_throughout"))
    assert throughout > 1.1 * end
    between = f"mean_velocity_throughout = {{ abs = {0.5 * (end + throughout)} }}"
    assert choose_with(instance, table_1(between, 8000.0, 0.01)).averaging_order != 1


def test_a_mean_throughout_begins_with_the_first_whole_period(instance: Instance) -> None:
    """At the start the slider rests, but the slow velocity of averages is not 0."""
    device = "[device]\nresonator_mass = 0.0\ntangential_force = 500.0\n"
    inputs = "[inputs]\nload = { steps = [[0.0, 0.0], [0.5, 0.02]] }\n"
    run = "[run]\nstop_time = 1.0\nsteps_per_period = 0.1\n"
    need = "[need]\nmean_velocity_throughout = { rel = 0.01 }\n"
    choice = choose_with(instance, scene_of(device + inputs + run + need))
    assert (choice.meets, choice.fidelity, choice.averaging_order) == (True, 0, 1)
    assert "steps also end where inputs jump" in "\n".join(choice.sentences())


RESONANCE = "resonator_frequency = 2474.8737341529163"


@pytest.mark.parametrize(
    ("device", "averages"),
    [
        ("friction_coefficient = 0.0", True),
        ("base_amplitude = 0.0\ninitial_velocity = 0.3", True),
        ("normal_preload = 0.0", True),
        (f"damping_ratio = 0.0\nresonator_mass = 1.0\n{RESONANCE}", False),
    ],
)
def test_averages_of_special_devices(instance: Instance, device: str, averages: bool) -> None:
    run = "[run]\ndrive_periods = 500\nsteps_per_period = 1\n"
    text = f"[device]\n{device}\n{run}[need]\nmean_velocity = {{ rel = 0.05 }}\n"
    choice = choose_with(instance, scene_of(text))
    assert choice.meets
    refused = [m for m in choice.ruled_out if "damping_ratio = 0.0 refused" in m.why]
    assert (refused == []) == averages
    assert all(choice.model.name != m.name for m in refused)


RAMPED = (
    "[inputs]\nload = { ramp = [[0, 0], [0.3, 0.04], [0.5, 0]] }\n"
    "phase = { ramp = [[0, 0.2], [0.5, 0.7]] }\n"
    "[run]\nstop_time = 0.5\nstep_size = 0.01\ninterpolate = %s\n"
    "[need]\nmean_velocity = { rel = 1e-7 }\n"
)


def test_straight_lines_that_are_passed_on_need_no_small_steps(instance: Instance) -> None:
    """Held, they err by the step; passed on, they are exact in a step of any length."""
    held, passed = (choose_with(instance, scene_of(RAMPED % says)) for says in ("false", "true"))
    assert (held.meets, held.inputs) == (False, "held")
    assert (passed.meets, passed.inputs, passed.step) == (True, "interpolated", 0.5)
    assert "interpolate = true" in " ".join(held.sentences())
    assert "inputs: straight lines between" in " ".join(passed.sentences())


@pytest.mark.slow
def test_an_fmu_that_takes_no_derivatives_has_straight_lines_held(python_fmu: Path) -> None:
    text = (RAMPED % "true").replace("1e-7", "0.2").replace("stop_time = 0.5", "stop_time = 0.1")
    choice = choose(scene_of(text), python_fmu)
    assert (choice.meets, choice.inputs) == (True, "cannot")
    assert "canInterpolateInputs = false" in " ".join(choice.sentences())
