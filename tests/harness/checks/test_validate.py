from dataclasses import replace
from pathlib import Path

import pytest

from slider_resonator.checks.expecting import EXPECTED
from slider_resonator.checks.fmu_side import PREDICTIONS, FmuSide
from slider_resonator.checks.measuring import CONDUCT, MEASURES, measure
from slider_resonator.checks.validate import validate, worst_of_sweeps
from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import ALL_OUTPUTS
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene_files import find_scene
from slider_resonator.scenes.vocabulary import QUANTITIES
from tests.harness import faulty_fmus
from tests.harness.scene_text import read_scene, scene_of
from tests.harness.verdicts import PASSED

EXPECT = '[[expect]]\nquantity = "steady_velocity"\nvalue = 0.126667\nrelative = 1e-6\nwhy = "x"\n'


def test_a_sweep_is_judged_at_every_point(native_fmu: Path) -> None:
    sweep = '[sweep]\nvariable = "phase"\nvalues = [0.0, 0.4]\n'
    (result,) = validate([native_fmu], [scene_of(EXPECT + sweep)])
    assert [dict(check.at) for check in result.checks] == [{"phase": 0.0}, {"phase": 0.4}]
    assert [check.passed for check in result.checks] == [True, False]
    ((worst, points),) = worst_of_sweeps(result.checks)
    assert (worst.at, points) == ({"phase": 0.4}, 2)


def test_a_failure_is_worse_than_any_pass() -> None:
    near, farther = replace(PASSED, deviation=9e-8), replace(PASSED, deviation=5e-8)
    ((worst, _),) = worst_of_sweeps([near, replace(PASSED, passed=False), farther])
    assert not worst.passed


def test_other_scenes_are_judged_after_a_refused_one(native_fmu: Path, tmp_path: Path) -> None:
    sound = read_scene(faulty_fmus.scene(tmp_path))
    refused = replace(
        sound.with_values({"friction_law": 1, "friction_coefficient": 0}), name="refused"
    )
    (validation,) = validate([native_fmu], [refused, sound])
    assert validation.exit_code == 2
    (run_failure,) = validation.run_failures
    assert run_failure.scene == "refused"
    assert "friction_coefficient = 0.0 refused" in run_failure.reason
    assert [(c.scene, c.passed) for c in validation.checks] == [("short", True)]


@pytest.fixture(scope="module")
def stranger(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return faulty_fmus.foreign(native_fmu, tmp_path_factory.mktemp("foreign") / "foreign.fmu")


LIFE = """
[run]
drive_periods = 2
steps_per_period = 8
[[expect]]
quantity = "position"
reference = "located_events"
relative = 1e-8
why = "references, order and capabilities do not matter"
[[expect]]
quantity = "event_times"
reference = "located_events"
tube = 1e-9
why = "no event is early or late"
[[expect]]
quantity = "blocking_force"
value = 0.0851861
relative = 1e-5
why = "table 1"
"""


@pytest.mark.isolated
def test_what_it_does_not_offer_is_listed_and_what_it_does_is_judged(stranger: Path) -> None:
    counts = [name for name in QUANTITIES if name.endswith(("_differences", "_faults"))]
    zero = f'[[expect]]\nquantity = {counts}\nvalue = 0\nwhy = "it must"\n'
    (validation,) = validate([stranger], [scene_of(LIFE + zero + EXPECT)])
    assert validation.exit_code == 0, [c for c in validation.checks if not c.passed]
    reasons = {one.quantity: one.reason for one in validation.not_applied}
    assert reasons == {
        "restored_differences": "needs canGetAndSetFMUstate = true",
        "transferred_differences": "needs canGetAndSetFMUstate = true",
        "beside_differences": "needs canBeInstantiatedOnlyOncePerProcess = false",
        "rate_differences": "needs canInterpolateInputs = true",
        "state_faults": "needs canGetAndSetFMUstate = true",
    }
    judged = {check.quantity for check in validation.checks}
    motion = {"position", "event_times", "blocking_force", "steady_velocity"}
    assert judged == {*motion, *counts} - set(reasons)


def test_an_fmu_that_takes_equal_steps(stranger: Path) -> None:
    """Bristles are read there; unequal steps are refused."""
    run = "[run]\ndrive_periods = 2\nsteps_per_period = 8\n"
    bristles = EXPECT.replace("value = 0.126667", 'reference = "located_events"')
    unequal = "[inputs]\nload = { steps = [[0.0, 0.0], [0.001, 0.05]] }\n"
    ends = '[[expect]]\nquantity = "reversals"\nat_least = 0\nwhy = "it runs"\n'
    sound = scene_of(f"[device]\nfriction_law = 1\n{run}{bristles}")
    (validation,) = validate([stranger], [sound, scene_of(unequal + run + ends)])
    assert [check.passed for check in validation.checks] == [True]
    (run_failure,) = validation.run_failures
    assert "canHandleVariableCommunicationStepSize = false" in run_failure.reason
    assert "must be one size" in run_failure.reason


def test_scene_that_needs_a_later_variable_does_not_apply(native_fmu: Path, tmp_path: Path) -> None:
    """An FMU of the first interface counts as one of order 1: it is judged on that."""
    old = faulty_fmus.without_later_variables(native_fmu, tmp_path / "old.fmu")
    scene = read_scene(faulty_fmus.scene(tmp_path))
    scenes = [
        replace(scene.with_values({"fidelity": 1, "averaging_order": order}), name=f"order_{order}")
        for order in (1, 2)
    ]
    (validation,) = validate([old], scenes)
    assert validation.exit_code == 0, validation.run_failures
    assert [check.scene for check in validation.checks] == ["order_1"]
    (missing,) = validation.not_applied
    assert (missing.scene, missing.quantity) == ("order_2", "position")
    assert missing.reason == "needs averaging_order, which came with interface 0.2.0"
    later = {"averaging_order", "prediction_valid", "slow_motion_error", "friction_power"}
    assert set(validation.lacks) == {*later, *DEVIATIONS}


def test_the_blocking_force_does_not_depend_on_the_load_of_the_scene(instance: Instance) -> None:
    loaded = FmuSide(instance, find_scene("table_1", {"load": 0.3}))
    free = FmuSide(instance, find_scene("table_1"))
    assert loaded.blocking.blocking_force == free.blocking.blocking_force


RUN = "[run]\ndrive_periods = 4\nsteps_per_period = 2\n"
SLOW = "[device]\nfidelity = 0\n" + RUN
NUMBER = '[[expect]]\nquantity = "{}"\nat_most = 1.0\nwhy = "test"\n'
SIGNAL = '[[expect]]\nquantity = "{}"\nreference = "averaged"\nrelative = 1.0\nwhy = "test"\n'


@pytest.mark.parametrize("quantity", sorted(PREDICTIONS))
def test_a_scene_that_expects_a_prediction_reads_it(instance: Instance, quantity: str) -> None:
    side = FmuSide(instance, scene_of(SLOW))
    assert not set(PREDICTIONS.values()) & set(side.record.outputs), "nobody asks for them"
    expect = SIGNAL if quantity.endswith("_in_run") else NUMBER
    expecting = FmuSide(instance, scene_of(SLOW + expect.format(quantity)))
    assert measure(quantity, expecting).applicable
    assert PREDICTIONS[quantity] in expecting.record.outputs


def test_every_quantity_has_its_measure_or_is_an_output() -> None:
    measured = {*MEASURES, *CONDUCT}
    assert measured | set(PREDICTIONS) <= set(QUANTITIES)
    for name in QUANTITIES.keys() - measured:
        assert PREDICTIONS.get(name, name.removesuffix("_in_run")) in ALL_OUTPUTS


def test_every_reference_of_a_quantity_has_its_function() -> None:
    named = {name: set(quantity.references) for name, quantity in QUANTITIES.items()}
    assert {name: set(EXPECTED.get(name, {})) for name in QUANTITIES} == named
    assert set(EXPECTED) <= set(QUANTITIES)
