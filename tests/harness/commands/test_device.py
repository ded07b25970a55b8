import json
from pathlib import Path

import fmpy
import fmpy.ssp.ssd
from lxml import etree

import slider_resonator as sr
from tests.harness.calling import call
from tests.harness.public_json import assert_public_keys


def test_examples_are_listed_and_printed(tmp_path: Path) -> None:
    assert_public_keys("device", call("device", "--json").stdout)
    assert_public_keys("device NAME", call("device", "lugre_steel", "--json").stdout)
    assert "ultrasonic_slider" in call("device").stdout
    mine = tmp_path / "mine.toml"
    mine.write_text(call("device", "--example", "ultrasonic_slider").stdout, encoding="utf-8")
    shown = call("device", mine).stdout
    assert "20 kHz" in shown
    assert "125663.71 rad/s" in shown
    assert "friction of 1 face at the mean normal load: 750 mN" in shown
    assert "resonance of the slider without friction: 20.9762 kHz" in shown


def test_a_possible_slip_is_noted(tmp_path: Path, native_fmu: Path) -> None:
    path = tmp_path / "slip.toml"
    path.write_text("[device]\ndrive_frequency = 20000\n", encoding="utf-8")
    said = json.loads(call("device", path, "--json").stdout)
    assert said["possible_slips"]
    assert said["device"]["drive_frequency"]["shown"] == "3.1831 kHz"
    ran = call("steady", native_fmu, "--device", path)
    assert 'write drive_frequency = "20000 Hz"' in ran.stderr
    ran = call("steady", native_fmu, "--set", "drive_frequency=600")
    assert "note: drive_frequency = 600 is in rad/s, which is 95.493 Hz; if" in ran.stderr
    scene = tmp_path / "scene.toml"
    run = "[run]\ndrive_periods = 2\nsteps_per_period = 4\n"
    scene.write_text(f'name = "a"\ntitle = "a"\n{run}{path.read_text()}', encoding="utf-8")
    grid = ("--over", "drive_frequency=19000:21000:2", "--out", tmp_path / "a.csv")
    assert "if 20000 Hz is meant" in call("run", native_fmu, scene).stderr
    assert "if 20000 Hz is meant" in call("scenes", "--check", scene).stderr
    assert "if 21000 Hz is meant" in call("sweep", *grid, "--fmu", native_fmu).stderr


def test_a_device_without_a_drive_is_noted(tmp_path: Path, native_fmu: Path) -> None:
    path = tmp_path / "part.toml"
    path.write_text('[device]\nresonator_mass = 0\nbase_amplitude = "1 um"\n', encoding="utf-8")
    why = "nothing drives the slider: tangential_force = 0, base_amplitude = 1e-06 and"
    assert f"note: {why}" in call("device", path).stdout
    assert f"note: {path}: {why}" in call("steady", native_fmu, "--device", path).stderr
    path.write_text('[device]\nresonator_mass = 0\ntangential_force = "2 N"\n', encoding="utf-8")
    assert "nothing drives" not in call("device", path).stdout


def test_a_device_is_written_as_a_parameter_set_of_ssp(tmp_path: Path) -> None:
    """What the FMU gets from it is the device; the schema is that of the standard."""
    path = tmp_path / "conveyor.ssv"
    call("device", "conveyor", "--ssv", path)
    schema = Path(fmpy.__file__).parent / "ssp" / "schema"
    etree.XMLSchema(file=str(schema / "SystemStructureParameterValues.xsd")).assertValid(
        etree.parse(path)
    )
    values = {one.name: one.value for one in fmpy.ssp.ssd.read_ssv(str(path)).parameters}
    expected = vars(sr.read_device("conveyor"))
    assert {name: float(value) for name, value in values.items()} == expected
