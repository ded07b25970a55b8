"""The harness drives FMUs of both versions of FMI, with the same numbers."""

import zipfile
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from slider_resonator.device.interface import OUTPUTS
from slider_resonator.device.schedule import Schedule
from slider_resonator.device.signal import constant
from slider_resonator.errors import FmuError, Refusal
from slider_resonator.fmu.instance import SavedState, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.run import Record, run
from tests.harness import faulty_fmus

TIMES = np.linspace(0.0, 0.04, 41)


def recorded(path: Path) -> Record:
    schedule = Schedule(TIMES, {"phase": constant(0.4), "load": constant(0.02)})
    with open_fmu(path) as fmu, instantiate(fmu) as instance:
        return run(instance, {"friction_law": 1, "fidelity": 1}, schedule)


def test_fmi_3_gives_the_numbers_of_fmi_2(native_fmu: Path, native_3_fmu: Path) -> None:
    ours, theirs = recorded(native_3_fmu), recorded(native_fmu)
    for name in OUTPUTS:
        peak = np.max(np.abs(theirs[name])) or 1.0
        assert np.max(np.abs(ours[name] - theirs[name])) <= 1e-13 * peak, name


def test_a_refusal_of_fmi_3_is_explained_and_leaves_the_instance_usable(native_3_fmu: Path) -> None:
    with open_fmu(native_3_fmu) as fmu, instantiate(fmu) as instance:
        assert fmu.version == "3.0"
        with pytest.raises(FMICallException, match="fmi3DoStep failed"):
            instance.step_by(0.01)
        with pytest.raises(FMICallException, match="fmi3GetFloat64 failed"):
            instance.value("position")
        with pytest.raises(Refusal, match="load = nan refused: must be a finite number"):
            instance.start({"load": float("nan")})
        instance.start({"fidelity": 2, "load": 0.1}, stop_time=1.0)
        assert instance.read(["fidelity", "load"]) == {"fidelity": 2.0, "load": 0.1}
        with pytest.raises(Refusal, match="the step must end by stopTime"), instance.explained():
            instance.step_by(2.0)
        saved = SavedState.of(instance)
        instance.step_by(0.5)
        reached = instance.value("position")
        saved.transfer(instance)
        saved.free()
        instance.step_by(0.5)
        assert instance.value("position") == reached


def test_an_fmu_of_fmi_3_that_cannot_be_instantiated(native_3_fmu: Path, tmp_path: Path) -> None:
    with open_fmu(native_3_fmu) as fmu:
        token = str(fmu.description.guid).encode()
    other = b"00000000-0000-0000-0000-000000000000"
    path = faulty_fmus.redescribed(native_3_fmu, tmp_path / "other.fmu", token, other)
    with (
        open_fmu(path) as fmu,
        pytest.raises(FmuError, match=r"cannot be instantiated: .*instantiationToken"),
        instantiate(fmu),
    ):
        pass


def test_a_binary_for_another_platform_is_named(native_3_fmu: Path, tmp_path: Path) -> None:
    path = tmp_path / "far.fmu"
    with zipfile.ZipFile(native_3_fmu) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            far = "binaries/riscv64-linux/x.so" if name.startswith("binaries/") else name
            new.writestr(far, old.read(name))
    with pytest.raises(FmuError, match=r"no binary for .*, only for riscv64-linux"), open_fmu(path):
        pass
