"""A baseline as its users see it: recorded, checked, accepted."""

import json
import re
import shutil
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from click.testing import Result

from slider_resonator.commands import baseline as commands
from slider_resonator.scenes.scene_files import find_scene
from tests.harness import calling, faulty_fmus
from tests.harness.public_json import assert_public_keys


def run(verb: str, fmu: Path, folder: Path, *options: object) -> Result:
    return calling.call("baseline", verb, fmu, "--dir", folder, *options)


def refused(verb: str, fmu: Path, folder: Path, *options: object) -> str:
    return calling.refused("baseline", verb, fmu, "--dir", folder, *options)


@pytest.fixture(scope="module")
def scenes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("scenes")
    faulty_fmus.scene(folder, "one")
    swept = faulty_fmus.scene(folder, "two")
    swept.write_text(swept.read_text() + '[sweep]\nvariable = "phase"\nvalues = [0.0, 0.4]\n')
    return folder


@pytest.fixture(scope="module")
def recorded(native_fmu: Path, scenes: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recorded") / "baseline"
    result = run("record", native_fmu, folder, "--scene", scenes)
    assert result.exit_code == 0, result.output
    return folder


@pytest.fixture(scope="module")
def other_fmu(python_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return faulty_fmus.other_friction(python_fmu, tmp_path_factory.mktemp("other") / "other.fmu")


@pytest.fixture
def baseline(recorded: Path, scenes: Path, tmp_path: Path) -> Path:
    """A copy of the baseline, as far from the scenes as the original."""
    shutil.copytree(scenes, tmp_path / scenes.name)
    return Path(shutil.copytree(recorded, tmp_path / recorded.parent.name / recorded.name))


@pytest.fixture
def scene(baseline: Path, scenes: Path) -> Path:
    """The copy of the first scene that belongs to that copy."""
    return baseline.parents[1] / scenes.name / "one.toml"


def content(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*.csv")}


def test_both_builds_give_the_same_golden_results(python_fmu: Path, baseline: Path) -> None:
    result = run("check", python_fmu, baseline)
    assert result.exit_code == 0, result.output
    assert "checks passed" in result.stdout
    assert "baseline" not in result.stdout, "nothing has changed, nothing is shown"


def test_a_change_is_shown_kept_and_accepted(
    native_fmu: Path, other_fmu: Path, baseline: Path, scene: Path, tmp_path: Path
) -> None:
    before = content(baseline)
    reports = [tmp_path / name for name in ("report.json", "report.xml", "report.html")]
    options = [*("--json", reports[0]), *("--junit", reports[1]), *("--html", reports[2])]
    changed = run("check", other_fmu, baseline, "--scene", scene, *options)
    assert changed.exit_code == 1, changed.output
    assert "one: blocking_force" in changed.stdout
    assert "times the allowed" in changed.stdout
    assert json.loads(reports[0].read_text())["exit_code"] == 1
    assert_public_keys("validate ONE", reports[0].read_text())
    assert int(ET.parse(reports[1]).getroot().get("failures", "0")) > 5
    assert "<h1>Slider-resonator baseline</h1>" in reports[2].read_text(encoding="utf-8")
    assert run("check", other_fmu, baseline).exit_code == 1
    assert content(baseline).items() >= before.items(), "a check changes no golden result"
    assert (baseline / ".changed" / ".gitignore").read_text() == "*\n"

    assert "not the FMU that was last checked" in refused("accept", native_fmu, baseline)
    unknown = refused("accept", other_fmu, baseline, "--scene", "three")
    assert "(must be one of one, two)" in unknown
    accepted = run("accept", other_fmu, baseline, "--scene", "two")
    assert (accepted.exit_code, accepted.stdout) == (0, "accepted two\n")
    after = content(baseline)
    assert after["one/numbers.csv"] == before["one/numbers.csv"]
    assert after["two/numbers.csv"] != before["two/numbers.csv"]
    assert run("accept", other_fmu, baseline).stdout == "accepted one\n"
    assert run("accept", other_fmu, baseline).stdout.startswith("accepted nothing")
    assert run("check", other_fmu, baseline).exit_code == 0
    assert run("check", native_fmu, baseline, "--scene", scene).exit_code == 1


def test_nothing_is_replaced_unasked(native_fmu: Path, baseline: Path, scene: Path) -> None:
    before = content(baseline)
    again = refused("record", native_fmu, baseline, "--scene", scene)
    assert "recorded already: one" in again
    assert run("record", native_fmu, baseline, "--scene", scene, "--replace").exit_code == 0
    assert content(baseline) == before, "the same FMU gives the same bytes"


@pytest.mark.slow
def test_an_edited_scene_is_recorded_anew(native_fmu: Path, baseline: Path, scene: Path) -> None:
    text = scene.read_text()
    scene.write_text(text.replace("the motion itself must agree", "it is what it was"))
    assert run("check", native_fmu, baseline).exit_code == 0, "it still runs the same"
    scene.write_text(text.replace("drive_periods = 2", "drive_periods = 3"))
    result = run("check", native_fmu, baseline)
    assert result.exit_code == 2
    assert "record it again with --replace" in result.stderr


def test_what_cannot_run_exits_with_2(native_fmu: Path, baseline: Path, tmp_path: Path) -> None:
    fmu = faulty_fmus.compiled(native_fmu, tmp_path / "no.fmu", "IN_STEP=return 3;", "VALUE=1.0")
    report = tmp_path / "report.json"
    assert "fmi2DoStep failed" in refused("check", fmu, baseline, "--json", report)
    assert len(json.loads(report.read_text())["errors"]) == 3, "one for each point"
    recording = run("record", fmu, tmp_path / "new", "--scene", "table_1")
    assert recording.exit_code == 2
    assert recording.stdout.startswith("recorded 0 scenes")


def test_what_is_not_recorded_is_named(native_fmu: Path, baseline: Path, tmp_path: Path) -> None:
    said = refused("check", native_fmu, baseline, "--scene", "table_1")
    assert "unknown recorded scene 'table_1'" in said
    report = tmp_path / "report.json"
    said = refused("check", native_fmu, tmp_path / "empty", "--json", report)
    assert "nothing is recorded here; `slider-resonator baseline record FMU --dir " in said
    assert "nothing is recorded" in json.loads(report.read_text())["error"]
    file = baseline / "one" / "provenance.csv"
    file.write_text(re.sub("(?m)^scene_file,.*$", "scene_file,built in", file.read_text()))
    said = refused("check", native_fmu, baseline)
    assert f"{baseline / 'one'}: recorded of a built-in scene" in said


def test_changes_that_cannot_be_kept_are_shown(other_fmu: Path, baseline: Path) -> None:
    (baseline / ".changed").write_text("in the way of what accept takes over")
    result = run("check", other_fmu, baseline)
    assert result.exit_code == 2
    assert "one: blocking_force" in result.stdout
    assert "could not be kept for accept" in result.stderr


@pytest.mark.slow
def test_ramps_apply_to_some_fmus_only(native_fmu: Path, python_fmu: Path, tmp_path: Path) -> None:
    scenes, folder = tmp_path / "scenes", tmp_path / "baseline"
    scenes.mkdir()
    faulty_fmus.scene(scenes, "one")
    line = faulty_fmus.scene(scenes, "two")
    text = line.read_text().replace("[run]", "[run]\ninterpolate = true")
    line.write_text(text + "[inputs]\nload = { ramp = [[0.0, 0.0], [0.01, 0.1]] }\n")
    assert run("record", native_fmu, folder, "--scene", scenes).exit_code == 0
    assert run("check", native_fmu, folder).exit_code == 0
    other = run("check", python_fmu, folder)
    assert other.exit_code == 0, other.output
    assert "not applicable: two: the run: needs canInterpolateInputs = true" in other.stdout
    said = refused("record", python_fmu, tmp_path / "other", "--scene", line)
    assert "canInterpolateInputs" in said


def test_scenes_that_do_not_apply_are_left_out(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    old = faulty_fmus.without_later_variables(native_fmu, tmp_path / "old.fmu")
    scenes = ("burst", "tuned", "table_1")
    named = run("record", old, tmp_path / "named", *(f"--scene={name}" for name in scenes))
    assert (named.exit_code, named.stdout[:17]) == (2, "recorded 1 scene ")
    assert "scene tuned at friction_faces 1: needs amplitude_deviation" in named.stderr
    few = [find_scene(name) for name in scenes]
    monkeypatch.setattr(commands, "find_scenes", lambda names: few)
    assert run("record", old, tmp_path / "all").exit_code == 0
    assert sorted(path.name for path in (tmp_path / "all").iterdir()) == ["table_1"]
