from __future__ import annotations

from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.device.schedule import constant, schedule, steps
from slider_resonator.errors import FmuError, Refusal
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import Fmu
from slider_resonator.fmu.run import run
from tests.fmus import both_fmus

pytestmark = both_fmus

PERIOD = 2.0 * pi / 3500.0


def test_a_run_records_every_output_at_every_point(instance: Instance) -> None:
    record = run(instance, {}, schedule(10 * PERIOD, PERIOD))
    assert record.times.shape == (11,)
    assert record["position"].shape == (11,)
    assert record["position"][0] == 0.0
    assert record.final("reversals") == 19.0, "two reversals in each period but the first"
    assert record.wall_time > 0.0
    assert record.start_cpu > 0.0
    assert record.step_cpu > 0.0


def test_a_second_run_starts_afresh(instance: Instance) -> None:
    first = run(instance, {"base_amplitude": 2e-4}, schedule(5 * PERIOD, PERIOD))
    again = run(instance, {}, schedule(5 * PERIOD, PERIOD))
    fresh = run(instance, {}, schedule(5 * PERIOD, PERIOD))
    assert np.array_equal(again["position"], fresh["position"])
    assert not np.array_equal(first["position"], again["position"])


def test_inputs_reach_the_fmu_at_their_time_and_not_before(instance: Instance) -> None:
    at = 3.5 * PERIOD
    loaded = schedule(6 * PERIOD, PERIOD, load=steps([(0.0, 0.0), (at, 0.5)]))
    free = schedule(6 * PERIOD, PERIOD, load=steps([(0.0, 0.0), (at, 0.0)]))
    one, two = run(instance, {}, loaded), run(instance, {}, free)
    before = one.times <= at
    assert np.array_equal(one["velocity"][before], two["velocity"][before])
    assert np.all(one["velocity"][~before] < two["velocity"][~before]), "load opposes +X"


def test_integers_are_set_as_integers(instance: Instance) -> None:
    instance.start({"friction_faces": 1.0})
    assert instance.value("friction_faces") == 1.0
    with pytest.raises(FmuError, match=r"friction_faces = 1.5: allowed is an integer"):
        instance.start({"friction_faces": 1.5})
    for bad in (float("nan"), float("inf"), 2.0**32 + 2.0):
        with pytest.raises(FmuError, match=r"friction_law = .*: allowed is an integer"):
            instance.start({"friction_law": bad})


def test_variables_of_both_types_are_read_together(instance: Instance) -> None:
    instance.start({"friction_faces": 1, "phase": 0.3})
    read = instance.read(["phase", "friction_faces", "blocking_force"])
    assert read["phase"] == 0.3
    assert read["friction_faces"] == instance.value("friction_faces") == 1.0
    assert read["blocking_force"] == instance.value("blocking_force") > 0.0


def test_what_has_been_read_can_be_set_no_more_than_before(instance: Instance) -> None:
    instance.start({})
    instance.read(["position"])
    with pytest.raises(FmuError, match="position"):
        instance.start({"position": 1.0})


def test_a_refusal_carries_the_words_of_the_fmu(instance: Instance) -> None:
    with pytest.raises(Refusal) as caught:
        instance.start({"slider_mass": -1.0})
    message = str(caught.value)
    assert "slider_mass = -1.0" in message
    assert "t = 0 s" in message
    assert message.count("slider_mass") == 1, "said once"
    assert "Refusal" not in message, "without pythonfmu's wrapping"
    assert "fmi2" not in message
    instance.start({})
    with pytest.raises(Refusal, match="phase"), instance.explained():
        instance.set_inputs([float("nan"), 0.0, 1.0])
    record = run(instance, {}, schedule(PERIOD, PERIOD))
    assert record.final("position") != 0.0, "the instance is usable after a refusal"


def test_a_refusal_in_a_run_is_raised_and_no_short_record_returned(instance: Instance) -> None:
    bad = schedule(4 * PERIOD, PERIOD, load=constant(float("1e308")))
    with pytest.raises(Refusal):
        run(instance, {"friction_coefficient": -1.0}, bad)


def test_unknown_names_suggest_the_nearest(instance: Instance) -> None:
    with pytest.raises(FmuError, match="did you mean 'slider_mass'"):
        instance.start({"slider_mas": 1.0})
    with pytest.raises(FmuError, match="did you mean 'position'"):
        instance.block(["positon"])


def test_two_instances_do_not_disturb_each_other(fmu: Fmu, instance: Instance) -> None:
    alone = run(instance, {}, schedule(3 * PERIOD, PERIOD))
    with instantiate(fmu) as other:
        other.start({"phase": 1.0})
        instance.start({})
        for index in range(1, 4):
            other.step_to(index * PERIOD)
            instance.step_to(index * PERIOD)
        assert instance.value("position") == alone.final("position")
        assert other.value("position") != alone.final("position")


def test_an_fmu_that_cannot_be_instantiated_says_so(fmu: Fmu, tmp_path: Path) -> None:
    gutted = replace(fmu, folder=tmp_path)
    with (
        pytest.raises(FmuError, match=r"cannot be instantiated.*shared library"),
        instantiate(gutted),
    ):
        pass


def test_an_instance_that_was_never_started_is_freed_without_complaint(
    fmu: Fmu, capfd: pytest.CaptureFixture[str]
) -> None:
    with instantiate(fmu):
        pass
    assert capfd.readouterr().err == ""


def test_progress_is_told(instance: Instance) -> None:
    shares: list[float] = []
    run(instance, {}, schedule(20 * PERIOD, PERIOD), progress=shares.append)
    assert shares[-1] == 1.0
    assert shares == sorted(shares)
