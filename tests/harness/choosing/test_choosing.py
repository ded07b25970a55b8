"""Choices for scenes whose answer follows from physics."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.choosing import choose
from slider_resonator.choosing.candidate import Candidate
from slider_resonator.choosing.choice import Evaluation, cheapest
from slider_resonator.choosing.choosing import choose_with
from slider_resonator.choosing.probe import Probe
from slider_resonator.device.model import Model
from slider_resonator.errors import Refusal, SceneError
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene import Scene
from tests.harness.choosing.judging import candidates
from tests.harness.scene_text import scene_of, table_1

pytestmark = pytest.mark.usefixtures("stated_costs")


def test_mean_velocity_to_a_per_cent_needs_averaged_motion_in_one_step(instance: Instance) -> None:
    scene = table_1("mean_velocity = { rel = 0.01 }", periods=2000.0)
    choice = choose_with(instance, scene)
    assert (choice.meets, choice.fidelity) == (True, 0)
    assert choice.step == scene.stop_time
    assert choice.error["mean_velocity"] < choice.allowed["mean_velocity"]


def test_what_averaging_leaves_out_needs_the_full_device(instance: Instance) -> None:
    """Resolved throughout, or with leaps."""
    choice = choose_with(instance, table_1("position = { abs = 1e-9 }", steps=0.1))
    assert choice.meets
    assert (choice.fidelity, choice.averaging_order) in {(0, 2), (2, None)}
    why = {(m.fidelity, m.averaging_order): m.why for m in choice.ruled_out}
    assert all("position is off by" in why[model] for model in ((0, 1), (1, None)))


def test_events_rule_averaged_motion_out_unprobed(instance: Instance) -> None:
    scene = table_1("event_times = { abs = 1e-7 }", periods=50.0, steps=8.0)
    choice = choose_with(instance, scene)
    assert (choice.meets, choice.fidelity, choice.step) == (True, 2, scene.step_size)
    assert {m.fidelity: m.why for m in choice.ruled_out}[0] == "averaged motion has no events"


def test_a_need_below_rounding_is_not_met(instance: Instance) -> None:
    choice = choose_with(instance, table_1("position = { rel = 1e-15 }", periods=20.0))
    assert not choice.meets
    assert choice.fidelity == 2, "the nearest is reported"
    assert len(choice.ruled_out) == 4


def test_a_long_run_takes_second_order_where_first_does_not_do(instance: Instance) -> None:
    orders = []
    for need in ("1e-2", "1e-6"):
        choice = choose_with(
            instance, table_1(f"mean_velocity = {{ rel = {need} }}", periods=8000.0)
        )
        assert (choice.meets, choice.fidelity) == (True, 0)
        orders.append(choice.averaging_order)
    assert orders == [1, 2]


def test_where_nothing_is_leapt_over_resolved_motion_serves_as_well(instance: Instance) -> None:
    scene = scene_of(
        "[device]\ndamping_ratio = 0.0\nresonator_frequency = 3000.0\n"
        "[run]\ndrive_periods = 2000\nsteps_per_period = 0.1\n"
        "[need]\nposition = { rel = 1e-9 }\n"
    )
    choice = choose_with(instance, scene)
    assert (choice.fidelity, choice.averaging_order) in {(2, None), (0, 2)}
    assert "meets the needs too" in " ".join(m.why for m in choice.ruled_out)


def lugre(need: str, stiffness: float = 1e5, periods: int = 200, steps: int = 200) -> Scene:
    return scene_of(
        f"[device]\nfriction_law = 1\nbristle_stiffness = {stiffness}\n"
        f"[run]\ndrive_periods = {periods}\nsteps_per_period = {steps / periods}\n"
        f"[need]\n{need}\n"
    )


def test_a_tighter_need_takes_a_tighter_tolerance(instance: Instance) -> None:
    tolerances = [
        choose_with(instance, lugre(f"position = {{ rel = {need} }}")).tolerance
        for need in (1e-5, 1e-7, 1e-8)
    ]
    assert tolerances == sorted(tolerances, reverse=True)
    assert len(set(tolerances)) == 3


@pytest.mark.parametrize(
    ("stiffness", "law"),
    [(1e12, 0), (1e8, 1)],
)
def test_a_free_law_is_coulombs_where_the_bristle_is_stiff(
    instance: Instance, stiffness: float, law: int
) -> None:
    """The laws differ for a share of 1e-4 of the time in the one case, of 0.01 in the other."""
    scene = lugre('position = { rel = 1e-4 }\nfriction_law = "free"', stiffness, 1000, 20)
    choice = choose_with(instance, scene)
    assert (choice.meets, choice.friction_law) == (True, law)


def test_a_law_that_is_given_is_kept(instance: Instance) -> None:
    scene = lugre("position = { rel = 1e-4 }", 1e10)
    assert {candidate.model.friction_law for candidate in candidates(instance, scene)} == {1}
    assert choose_with(instance, scene).friction_law == 1


def test_steady_needs_choose_between_theory_and_shooting(instance: Instance) -> None:
    loose = choose_with(instance, scene_of("[need]\nsteady_velocity = { rel = 0.01 }\n"))
    tight = choose_with(instance, scene_of("[need]\nsteady_velocity = { rel = 1e-7 }\n"))
    assert (loose.meets, loose.fidelity, loose.step) == (True, 0, None)
    assert (loose.averaging_order, tight.averaging_order) == (1, 2)
    assert (tight.meets, tight.fidelity, tight.step) == (True, 0, None), "by the period map: exact"


@pytest.mark.parametrize("need", ["steady_velocity", "blocking_force"])
def test_an_output_of_the_theory_costs_less_than_a_search(instance: Instance, need: str) -> None:
    scene = scene_of(f"[device]\nfriction_law = 1\n[need]\n{need} = {{ rel = 0.01 }}\n")
    choice = choose_with(instance, scene)
    assert (choice.meets, choice.fidelity) == (True, 0)
    searches = [why.why for why in choice.ruled_out if why.fidelity > 0]
    assert all("costs about" in why for why in searches)


@pytest.mark.parametrize(
    ("inputs", "need", "message"),
    [
        ("load = 1.0", "steady_velocity", "load_above_friction"),
        (
            "",
            "beat",
            "no beat at frequency_ratio = 1: at an integer the difference of the two phases is",
        ),
        (
            *("frequency_ratio = 1.5", "beat"),
            "no beat at frequency_ratio = 1.5: it is farther than 0.1 from an integer",
        ),
        ("frequency_ratio = 1.001", "beat", "0.15 beats"),
    ],
)
def test_a_quantity_that_does_not_exist_is_met_by_no_model(
    instance: Instance, inputs: str, need: str, message: str
) -> None:
    run = "[run]\ndrive_periods = 300\nsteps_per_period = 1\n" if need == "beat" else ""
    scene = scene_of(f"[inputs]\n{inputs}\n{run}[need]\n{need} = {{ rel = 0.1 }}\n")
    choice = choose_with(instance, scene)
    assert not choice.meets
    assert message in choice.reason
    assert len(choice.ruled_out) == 4


def test_a_beat_is_read_from_averaged_motion(instance: Instance) -> None:
    scene = scene_of(
        "[inputs]\nfrequency_ratio = 1.02\n[run]\ndrive_periods = 1000\nsteps_per_period = 1\n"
        "[need]\nbeat = { rel = 1e-2 }\n",
    )
    choice = choose_with(instance, scene)
    assert (choice.meets, choice.fidelity) == (True, 0)
    assert choice.step is not None
    assert choice.step * choice.scales.beat <= 1.0 / 4.0


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
        return Evaluation(Candidate(model, tolerance, 1.0), {}, {}, cost, "whole")

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
    errors = Probe(instance, scene).measure(averaged).errors
    end, throughout = (errors[f"mean_velocity{part}"].error for part in ("", "_throughout"))
    assert throughout > 1.1 * end
    between = f"mean_velocity_throughout = {{ abs = {0.5 * (end + throughout)} }}"
    assert choose_with(instance, table_1(between, 8000.0, 0.01)).averaging_order != 1


@pytest.mark.parametrize(
    ("device", "averages"),
    [
        ("friction_coefficient = 0.0", True),
        ("base_amplitude = 0.0\ninitial_velocity = 0.3", True),
        ("normal_preload = 0.0", True),
        (
            "damping_ratio = 0.0\nresonator_mass = 1.0\nresonator_frequency = 2474.8737341529163",
            False,
        ),
    ],
)
def test_averages_serve_without_friction_or_vibration_but_not_in_undamped_resonance(
    instance: Instance, device: str, averages: bool
) -> None:
    run = "[run]\ndrive_periods = 500\nsteps_per_period = 1\n"
    text = f"[device]\n{device}\n{run}[need]\nmean_velocity = {{ rel = 0.05 }}\n"
    choice = choose_with(instance, scene_of(text))
    assert choice.meets
    refused = [m for m in choice.ruled_out if "damping_ratio = 0.0 refused" in m.why]
    assert (refused == []) == averages
    assert all(choice.model != m.model for m in refused)


def test_a_scene_without_needs_is_refused(instance: Instance) -> None:
    with pytest.raises(SceneError, match=r"no \[need\].*mean_velocity = \{ rel = 0.01 \}"):
        choose_with(instance, scene_of(""))


def test_a_device_that_the_fmu_refuses_is_no_answer(instance: Instance) -> None:
    run = "[run]\ndrive_periods = 10\nsteps_per_period = 1\n[need]\nposition = { rel = 1.0 }\n"
    device = "[device]\nfriction_law = 1\nfriction_coefficient = 0.0\n"
    with pytest.raises(Refusal, match="friction_coefficient"):
        choose_with(instance, scene_of(device + run))


@pytest.mark.slow
def test_the_python_fmu_gets_the_same_answer(native_fmu: Path, python_fmu: Path) -> None:
    scene = table_1("mean_velocity = { rel = 0.05 }", periods=100.0)
    native, python = (choose(scene, fmu) for fmu in (native_fmu, python_fmu))
    assert (native.fidelity, native.step) == (python.fidelity, python.step)
    assert native.error == pytest.approx(python.error, rel=1e-6)
