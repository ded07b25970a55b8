import json
from pathlib import Path

import numpy as np
import pytest

import slider_resonator as sr
from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys


@pytest.fixture(scope="module")
def data(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("fit") / "data.csv"
    with sr.open_fmu(native_fmu, device="ultrasonic_slider") as fmu:
        rows = [
            f"{phase},{1e3 * fmu.steady(phase=f'{phase} deg', damping_ratio=0.03).predicted:.6g}"
            for phase in (-40, -10, 20, 50)
        ]
    path.write_text("\n".join(["phase [deg],velocity [mm/s]", *rows]) + "\n", encoding="utf-8")
    return path


def test_a_fit_writes_its_device(data: Path, native_fmu: Path, tmp_path: Path) -> None:
    device = ("--device", "ultrasonic_slider", "--fmu", native_fmu)
    ran = call("fit", data, *device, "--free", "damping_ratio", "--starts", 1, "--out", tmp_path)
    assert ran.exit_code == 0, ran.output
    assert "friction on 1 face (friction_faces)" in ran.stdout
    assert sr.read_device(tmp_path / "device.toml").damping_ratio == pytest.approx(0.03, rel=1e-4)
    written = {"device.toml", "fit.html", "fit.png", "residuals.csv"}
    assert {path.name for path in tmp_path.iterdir()} == written
    other = tmp_path / "mine"
    other.mkdir()
    (other / "device.toml").write_text("[device]\n", encoding="utf-8")
    said = refused("fit", data, *device, "--free", "damping_ratio", "--out", other)
    assert "has a device.toml that no fit has written" in " ".join(said.split())
    assert "95 % from" in (tmp_path / "fit.html").read_text(encoding="utf-8")
    residuals = np.genfromtxt(tmp_path / "residuals.csv", delimiter=",", names=True)
    assert np.rad2deg(residuals["phase"]) == pytest.approx([-40.0, -10.0, 20.0, 50.0])
    again = ("--device", tmp_path / "device.toml", "--free", "damping_ratio", "--out", tmp_path)
    said = refused("fit", data, "--fmu", native_fmu, *again)
    assert "device.toml is the device; must be a file of its own" in " ".join(said.split())


def test_a_setting_is_not_a_column(data: Path, native_fmu: Path) -> None:
    free = ("--free", "damping_ratio", "--fmu", native_fmu)
    said = refused("fit", data, *free, "--set", "load=500 mN", "phase=0.3")
    assert f"phase = 0.3: {data} has values of phase; must be one of the two" in said
    with pytest.raises(sr.HarnessError, match=r"^phase = 0\.3: .* has values of phase"):
        sr.fit(data, "damping_ratio", native_fmu, phase=0.3)


def test_what_is_left_open_is_exit_code_1(data: Path, native_fmu: Path) -> None:
    free = "normal_preload,normal_amplitude,friction_coefficient"
    ran = call("fit", data, "--fmu", native_fmu, "--free", free, "--starts", 1, "--json")
    assert ran.exit_code == 1, ran.output
    assert_public_keys("fit", ran.stdout)
    open_ones = [one["name"] for one in json.loads(ran.stdout)["parameters"] if one["is_open"]]
    assert sorted(open_ones) == sorted(free.split(","))


@pytest.mark.parametrize(
    ("datasheet", "code", "text"),
    [
        ("--velocity=5 m/s", 1, "must be 5 m/s, the nearest found is"),
        ("--velocity-at=1 N=10 mm/s", 1, "must be 10 mm/s, but no steady motion was found"),
        ("--blocking=2 N", 0, "as many parameters as numbers: solved, without intervals"),
    ],
)
def test_doubtful_datasheets(native_fmu: Path, datasheet: str, code: int, text: str) -> None:
    free = ("--free", "friction_coefficient", "--starts", 3, "--fmu", native_fmu)
    ran = call("fit", datasheet, *free)
    assert ran.exit_code == code, ran.output
    assert text in " ".join(ran.stdout.split())
    assert "nan" not in ran.stdout
    assert "met as well" not in ran.stdout
