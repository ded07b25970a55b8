"""`validate` as CI jobs use it: exit codes and report files in every case."""

import json
import re
from importlib import resources
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from click.testing import Result

from tests.harness import faulty_fmus
from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys
from tests.processes import ROOT


def reported(folder: Path, *arguments: object) -> tuple[Result, dict[str, object], ET.Element]:
    """Run with all reports and return the result, the JSON and the JUnit document."""
    names = ("report.json", "report.xml", "report.html", "summary.md")
    files = [folder / name for name in names]
    options = [*("--json", files[0]), *("--junit", files[1]), *("--html", files[2])]
    result = call("validate", *arguments, *options, GITHUB_STEP_SUMMARY=str(files[3]))
    assert files[2].read_text(encoding="utf-8").endswith("</html>\n")
    assert "## Slider-resonator validation" in files[3].read_text()
    assert sorted(folder.glob(".report*")) == [], "no temporary file is left"
    return result, json.loads(files[0].read_text()), ET.parse(files[1]).getroot()


def test_a_pass_exits_with_0(native_fmu: Path, tmp_path: Path) -> None:
    result, report, junit = reported(tmp_path, native_fmu, "--scene", faulty_fmus.scene(tmp_path))
    assert result.exit_code == 0, result.output
    assert report["passed"] is True
    assert "1 of 1 checks passed" in result.stdout
    assert (junit.get("failures"), junit.get("errors")) == ("0", "0")


def test_a_failure_exits_with_1(native_fmu: Path, tmp_path: Path) -> None:
    still = faulty_fmus.compiled(native_fmu, tmp_path / "still.fmu", "IN_STEP=PRINT")
    result, report, junit = reported(tmp_path, still, "--scene", faulty_fmus.scene(tmp_path))
    assert result.exit_code == 1, result.output
    assert report["passed"] is False
    assert junit.get("failures") == "1"
    assert "off by 1 of the peak" in result.stdout, "it stands where it should move"
    assert "FMU on reference" in (tmp_path / "report.html").read_text(encoding="utf-8")
    must = "must be a finite number of at least 1e-06 rad/s"
    assert f"still.fmu reports drive_frequency = 0.0: {must}\n" in refused("steady", still)


@pytest.mark.parametrize(
    ("old", "new", "cause"),
    [(b'guid="', b'guid="0', "GUID"), (b"</ModelStructure>", b"", "cannot read")],
)
def test_run_failures_are_in_all_reports(
    native_fmu: Path, tmp_path: Path, old: bytes, new: bytes, cause: str
) -> None:
    fmu = faulty_fmus.redescribed(native_fmu, tmp_path / "faulty.fmu", old, new)
    result, report, junit = reported(tmp_path, fmu, "--scene", faulty_fmus.scene(tmp_path))
    assert result.exit_code == 2
    (error,) = junit.iter("error")
    for said in (result.stderr, json.dumps(report["errors"]), str(error.get("message"))):
        assert cause in said


def test_the_option_that_limits_the_scenes_is_named(native_fmu: Path, tmp_path: Path) -> None:
    sound, not_taken = faulty_fmus.scene(tmp_path), faulty_fmus.scene(tmp_path, "not_taken")
    device = "[device]\nfriction_law = 1\nfriction_coefficient = 0.0\n"
    not_taken.write_text(not_taken.read_text() + device)
    said = refused("validate", native_fmu, "--scene", tmp_path)
    assert "scene not_taken: SliderResonator.fmu at t = 0 s: friction_coefficient = 0.0" in said
    assert said.endswith("note: --scene limits the scenes to those that the FMU can run\n")
    assert "note:" not in refused("validate", native_fmu, "--scene", not_taken)
    assert call("validate", native_fmu, "--scene", sound).stderr == ""


def test_an_fmu_on_which_nothing_applies_passes_beside_others(
    native_fmu: Path, tmp_path: Path
) -> None:
    other = faulty_fmus.redescribed(
        *(native_fmu, tmp_path / "other.fmu"),
        *(b'canInterpolateInputs="true"', b'canInterpolateInputs="false"'),
    )
    scene = faulty_fmus.scene(tmp_path)
    text = scene.read_text().replace("[run]", "[run]\ninterpolate = true")
    scene.write_text(text + "[inputs]\nload = { ramp = [[0.0, 0.0], [0.002, 0.1]] }\n")
    both, report, _ = reported(tmp_path, native_fmu, other, "--scene", scene)
    assert (both.exit_code, report["passed"], both.stderr) == (0, True, "")
    alone, report, _ = reported(tmp_path, other, "--scene", scene)
    said = f"error: {other}: none of 1 check applies\n"
    assert (alone.exit_code, report["passed"], alone.stderr) == (2, False, said)


def test_a_scene_at_fault_is_reported_too(native_fmu: Path, tmp_path: Path) -> None:
    scene = tmp_path / "mine.toml"
    scene.write_text('name = "mine"\ntitle = "It expects nothing"\n')
    result, report, junit = reported(tmp_path, native_fmu, "--scene", scene)
    assert (result.exit_code, junit.get("errors")) == (2, "1")
    for said in (result.stderr, str(report["error"])):
        assert "mine.toml" in said


def test_the_public_keys_of_several_fmus_stay(native_fmu: Path, tmp_path: Path) -> None:
    failing = faulty_fmus.compiled(native_fmu, tmp_path / "failing.fmu", "IN_STEP=return 3;")
    scene = faulty_fmus.scene(tmp_path)
    scene.write_text(scene.read_text() + '[sweep]\nvariable = "phase"\nvalues = [0.0, 0.4]\n')
    result = call("validate", native_fmu, failing, "--scene", scene, "--json")
    assert result.exit_code == 2
    assert_public_keys("validate SEVERAL", result.stdout)


def test_no_report_replaces_what_is_validated(native_fmu: Path, tmp_path: Path) -> None:
    fmu, scene = tmp_path / "fmu.xml", tmp_path / "scene.xml"
    fmu.write_bytes(native_fmu.read_bytes())
    scene.write_text(faulty_fmus.scene(tmp_path).read_text())
    for option, target, reason in (
        ("--json", fmu, "must be one of .json"),
        ("--junit", scene, "must be a file of its own"),
        ("--junit", fmu, "must be a file of its own"),
    ):
        before = target.read_bytes()
        assert reason in refused("validate", fmu, "--scene", scene, option, target)
        assert target.read_bytes() == before


def test_the_examples_of_scene_files_pass(native_fmu: Path) -> None:
    template = Path(str(resources.files("slider_resonator.scenes") / "template.toml"))
    examples = ("--scene", template, "--scene", ROOT / "docs" / "every_key.toml")
    result = call("validate", "--fmu", native_fmu, *examples)
    assert result.exit_code == 0, result.output
    assert re.search(r"(\d+) of \1 checks passed", result.stdout)
