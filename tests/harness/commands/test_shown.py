"""Commands that show: scenes, devices, and the page, whose work in a browser hosts test."""

import json
import shutil
import zipfile
from pathlib import Path

import fmpy
import fmpy.ssp.ssd
import pytest
from lxml import etree

import slider_resonator as sr
from slider_resonator.commands import scenes as scenes_commands
from slider_resonator.scenes.json_schema import scene_schema
from slider_resonator.scenes.scene_files import find_scene
from slider_resonator.scenes.vocabulary import QUANTITIES
from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys
from tests.harness.scene_text import built_in


def test_the_list_says_which_scenes_can_be_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scenes_commands, "find_scenes", lambda _: [*built_in().values()])
    printed = call("scenes", "--json").stdout
    assert_public_keys("scenes", printed)
    scenes = json.loads(printed)
    length = {scene["name"]: scene["stop_time"] for scene in scenes}
    assert length["blocking_force"] is None
    assert length["pushed_at_rest"] == 0.1
    lines = call("scenes").stdout.splitlines()
    (row,) = [line for line in lines if line.split()[:1] == ["pushed_at_rest"]]
    assert "0.1 s" in row
    (row,) = [line for line in lines if line.split()[:1] == ["load_speed"]]
    assert " - " in row, "it has no run"


def test_what_scenes_can_expect_is_listed() -> None:
    printed = call("scenes", "--quantities", "--json").stdout
    assert_public_keys("scenes --quantities", printed)
    listed = json.loads(printed)
    assert [row["name"] for row in listed] == list(QUANTITIES)
    (events,) = [row for row in listed if row["name"] == "event_times"]
    assert events["references"] == ["located_events", "bristle_state", "averaged"]
    assert events["unit"] == "drive periods"
    assert "shooting" in call("scenes", "--quantities").stdout


def test_a_scene_is_shown_as_its_file_says() -> None:
    shown = call("scenes", "--show", "table_1").stdout
    assert shown == find_scene("table_1").files[0].read_text(encoding="utf-8")


def test_the_template_is_a_scene(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(call("scenes", "--template").stdout)
    assert call("scenes", "--check", path).stdout == f"{path}: valid, 2 checks\n"
    assert call("scenes", "--check", tmp_path).stdout == f"{path}: valid, 2 checks\n"


def test_the_schema_is_printed() -> None:
    assert json.loads(call("scenes", "--schema").stdout) == scene_schema()
    assert "--json does not go with --check" in refused("scenes", "--check", "table_1", "--json")


PAGE = '<head></head><script type="application/json" id="devices">{"table_1": "[device]"}</script>'


def fmu_with(page: str, folder: Path) -> Path:
    with zipfile.ZipFile(folder / "with_page.fmu", "w") as archive:
        archive.writestr("documentation/slider-resonator.html", page)
    return folder / "with_page.fmu"


def test_the_page_is_in_the_fmu_or_beside_it(native_fmu: Path, tmp_path: Path) -> None:
    beside = Path(shutil.copy(native_fmu, tmp_path))
    (tmp_path / "slider-resonator.html").write_text(PAGE, encoding="utf-8")
    for fmu in (fmu_with(PAGE, tmp_path), beside):
        out = tmp_path / f"{fmu.stem}.html"
        assert_public_keys("page", call("page", fmu, "--out", out, "--json").stdout)
        assert out.read_text(encoding="utf-8") == PAGE


def test_device_and_inputs_are_those_to_start_from(tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    settings = ("--set", "base_amplitude=1 um", "phase=0.5")
    call("page", fmu_with(PAGE, tmp_path), *settings, "--out", out)
    text = out.read_text(encoding="utf-8")
    assert 'id="devices">{"mine": "title = \\"Your device\\"' in text
    assert "base_amplitude = 1e-06" in text
    assert 'location.hash ||= "phase=0.5"' in text
    call("page", fmu_with(PAGE, tmp_path), "--device", "conveyor", "--out", out)
    assert '"mine": "title = \\"A part on a vibratory conveyor' in out.read_text(encoding="utf-8")


def test_an_fmu_without_a_page_is_refused(native_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "page.html"
    assert "must be a native FMU for all platforms" in refused("page", native_fmu, "--out", out)
    for page in ("<html></html>", PAGE.replace("}", "")):
        old = fmu_with(page, tmp_path)
        assert "has no list of devices" in refused("page", old, "--out", out)
    damaged = old.read_bytes()
    old.write_bytes(damaged.replace(b"<head>", b"<hand>"))
    assert "its page cannot be read" in refused("page", old, "--out", out)
    assert not out.exists()


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
