"""One instance of either build: calls, refusals and runs."""

import shutil
from concurrent.futures import ThreadPoolExecutor
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


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("friction_faces", 1.5, r"friction_faces = 1\.5: must be an integer"),
        ("friction_law", 2.0**32 + 2.0, r"friction_law = .*: must be an integer"),
        ("slider_mas", 1.0, "did you mean 'slider_mass'"),
        ("position", 1.0, "position"),
    ],
)
def test_wrong_values_are_refused(instance: Instance, name: str, value: float, said: str) -> None:
    instance.start({"friction_faces": 1.0})
    assert instance.read(["friction_faces", "position"])["friction_faces"] == 1.0
    with pytest.raises(FmuError, match=said):
        instance.start({name: value})
    with pytest.raises(FmuError, match="did you mean 'position'"):
        instance.block(["positon"])


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
        instance.inputs.write([float("nan"), 0.0, 1.0])
    record = run(instance, {}, schedule(PERIOD, PERIOD))
    assert record.final("position") != 0.0, "the instance is usable after a refusal"


def test_instance_that_cannot_be_recreated(fmu: Fmu, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError("no memory")

    with instantiate(fmu) as instance:
        instance.start({})
        with monkeypatch.context() as broken:
            broken.setattr(f"{Instance.__module__}.FMU2Slave", refuse)
            for attempt in (instance.recreate, instance.recreate, lambda: instance.start({})):
                with pytest.raises(FmuError, match="cannot be instantiated: no memory"):
                    attempt()
        instance.start({})
        assert instance.value("position") == 0.0


def test_loading_leaves_the_working_folder(
    fmu: Fmu, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    before = Path.cwd()

    def load(turn: int) -> None:
        with instantiate(fmu):
            pass

    with ThreadPoolExecutor(4) as threads:
        assert list(threads.map(load, range(40))) == [None] * 40
    assert Path.cwd() == before
    assert capfd.readouterr().err == "", "nobody complains that they were not started"
    broken = tmp_path / "broken"
    shutil.copytree(fmu.folder, broken)
    for library in (broken / "binaries").rglob(f"{fmu.offers.modelIdentifier}.*"):
        library.write_bytes(b"no library")
    with (
        pytest.raises(FmuError, match="cannot be instantiated"),
        instantiate(replace(fmu, folder=broken)),
    ):
        pass
    assert Path.cwd() == before


def test_what_an_fmu_writes_beyond_the_limit_is_named(instance: Instance) -> None:
    def refused() -> None:
        instance.messages.append("OSError(27, 'File too large')")
        instance.call("fmi2DoStep", -1.0, -1.0, True)

    limit = "File too large'[)]; .*may write or print at most 64 MiB"
    with pytest.raises(Refusal, match=limit), instance.explained():
        refused()
