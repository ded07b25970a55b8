from __future__ import annotations

from dataclasses import replace
from math import pi
from pathlib import Path

import pytest

from slider_resonator.device.schedule import schedule
from slider_resonator.errors import FmuError, Refusal
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import Fmu
from slider_resonator.fmu.run import run
from tests.fmus import both_fmus

pytestmark = both_fmus

PERIOD = 2.0 * pi / 3500.0


def test_integers_are_set_as_integers(instance: Instance) -> None:
    instance.start({"friction_faces": 1.0})
    assert instance.value("friction_faces") == 1.0
    with pytest.raises(FmuError, match=r"friction_faces = 1.5: must be an integer"):
        instance.start({"friction_faces": 1.5})
    for bad in (float("nan"), float("inf"), 2.0**32 + 2.0):
        with pytest.raises(FmuError, match=r"friction_law = .*: must be an integer"):
            instance.start({"friction_law": bad})


def test_variables_of_both_types_are_read_together(instance: Instance) -> None:
    instance.start({"friction_faces": 1, "phase": 0.3})
    read = instance.read(["phase", "friction_faces", "blocking_force"])
    assert read["phase"] == 0.3
    assert read["friction_faces"] == instance.value("friction_faces") == 1.0
    assert read["blocking_force"] == instance.value("blocking_force") > 0.0


def test_reading_a_variable_does_not_make_it_settable(instance: Instance) -> None:
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
    assert message.count("slider_mass") == 1, "reported once"
    assert "Refusal" not in message, "without pythonfmu's wrapping"
    assert "fmi2" not in message
    instance.start({})
    with pytest.raises(Refusal, match="phase"), instance.explained():
        instance.set_inputs([float("nan"), 0.0, 1.0])
    record = run(instance, {}, schedule(PERIOD, PERIOD))
    assert record.final("position") != 0.0, "the instance is usable after a refusal"


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


def test_an_fmu_that_cannot_be_instantiated_is_reported(fmu: Fmu, tmp_path: Path) -> None:
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


def test_a_recreated_instance_is_as_new(fmu: Fmu) -> None:
    with instantiate(fmu) as instance:
        instance.start({"phase": 1.0})
        instance.step_to(PERIOD)
        instance.recreate()
        assert instance.time == 0.0
        instance.start({})
        assert instance.value("phase") == 0.0
