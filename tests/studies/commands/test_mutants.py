import json
from pathlib import Path

import pytest

from tests.harness import faulty_fmus
from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys


def test_the_list_shows_names_and_diffs(python_fmu: Path) -> None:
    listing = ("mutants", python_fmu, "--list", "--file", "values.py")
    result = call(*listing, "--sample", "3")
    assert result.exit_code == 0, result.output
    assert result.output.count("--- values.py") == 3
    assert "3 variants" in result.output
    printed = call(*listing, "--file", "modelDescription.xml", "--json").output
    assert_public_keys("mutants --list", printed)
    mutants = json.loads(printed)["mutants"]
    assert {m["file"] for m in mutants} == {"values.py", "modelDescription.xml"}


@pytest.mark.slow
def test_rejected_mutants_pass_the_command(python_fmu: Path, tmp_path: Path) -> None:
    scene = faulty_fmus.scene(tmp_path)
    only = ("--file", "modelDescription.xml", "--sample", "2", "--seed", "1")
    result = call("mutants", python_fmu, *only, "--scene", scene, "--json")
    assert_public_keys("mutants", result.output)
    written = json.loads(result.output)
    assert written["tried"] == 2
    assert {m["kind"] for m in written["mutants"]} == {"unit"}
    rejected = written["counts"]["rejected"]
    assert written["rate"] == rejected / 2
    assert result.exit_code == (0 if rejected == 2 else 1)


@pytest.mark.parametrize(
    ("built", "arguments", "reason"),
    [
        ("tmp_path", [], "no such file"),
        ("python_fmu", ["--file", "valus.py"], "did you mean 'values.py'"),
        ("python_fmu", ["--file", "__init__.py"], "nothing to change"),
        ("python_fmu", ["--native"], "has no C sources to change"),
        ("native_fmu", ["--native", "--file", "lugr.c"], "did you mean 'lugre.c'"),
        ("native_fmu", ["--native", "--kind", "sign"], "must be without --kind"),
    ],
)
def test_runs_that_cannot_start_are_refused(
    request: pytest.FixtureRequest, built: str, arguments: list[str], reason: str
) -> None:
    fmu = request.getfixturevalue(built)
    assert reason in refused("mutants", fmu / "no.fmu" if fmu.is_dir() else fmu, *arguments)


@pytest.mark.isolated
@pytest.mark.slow
def test_a_native_run_counts_what_is_rejected(native_fmu: Path) -> None:
    scenes = ("--scene", "leap_lugre_flight", "--scene", "averaged_weak_drive")
    only = ("--native", "--file", "runge_kutta.c", *scenes, "--jobs", "1")
    result = call("mutants", native_fmu, *only, "--json")
    assert_public_keys("mutants --native", result.output)
    written = json.loads(result.output)
    rejected = {c["name"]: c["rejected"] for c in written["changes"]}
    assert rejected.pop("shorter_steps") is False, "it is harmless"
    assert rejected["runge_kutta_without_error"]
    assert written["rate"] == pytest.approx(sum(rejected.values()) / len(rejected))
    assert written["false_alarms"] == 0
    assert result.exit_code == 0, "each fault that is left is rejected"
