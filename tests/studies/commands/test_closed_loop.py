"""The loop in fmpy: its output, and the rejection of a loop that fails."""

import csv
import json
import tempfile
from pathlib import Path

import pytest

from studies.closed_loop import prediction
from studies.hosts.ssp_package import WITH_CONNECTORS
from tests.harness.calling import call, refused
from tests.harness.faulty_fmus import altered, reworded
from tests.harness.public_json import assert_public_keys


@pytest.mark.slow
def test_the_velocity_is_held_at_both_fidelities_and_they_agree(
    closed_loop_package: Path, tmp_path: Path
) -> None:
    done = call("closed-loop", closed_loop_package, "--out", tmp_path, "--json")
    assert done.exit_code == 0, done.output
    assert_public_keys("closed-loop", done.stdout)
    found = json.loads(done.stdout)
    assert [entry["fidelity"] for entry in found["held"]] == [0] * 5 + [2] * 5
    for entry in found["held"]:
        assert entry["after_settling"] <= 0.02
        assert entry["largest"] > 0.02, "each step of the load shows before the controller answers"
    assert [agreement["load"] for agreement in found["agreements"]] == [0.03, 0.06, -0.03, 0.0]
    for agreement in found["agreements"]:
        assert agreement["difference"] <= 1e-6, "short steps of order 2 are resolved"
        assert 0.0 < agreement["predicted"] < 1e-3
    assert (tmp_path / "closed_loop.png").read_bytes().startswith(b"\x89PNG")
    with (tmp_path / "closed_loop.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 800
    assert float(rows[-1]["fmpy fidelity 2 mean_velocity [m/s]"]) == pytest.approx(0.06, rel=1e-3)


@pytest.mark.slow
def test_a_controller_without_integral_does_not_hold(
    closed_loop_package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(prediction, "FIRST", 1)  # predictions do not matter here
    loose = reworded(closed_loop_package, tmp_path / "loose.ssp", '"400.0"', '"0.0"')
    done = call("closed-loop", loose, "--out", tmp_path)
    assert done.exit_code == 1
    assert "FAIL" in done.stdout
    assert "never" in done.stdout


@pytest.mark.parametrize(
    ("old", "new", "reported"),
    [
        ("slider.fidelity", "slider.detail", "parameter set design lacks slider.fidelity"),
        ("controller.force_phase", "controller.angle", "does not run in fmpy: KeyError: 'angle'"),
    ],
)
def test_a_package_that_cannot_be_run_is_no_verdict(
    closed_loop_package: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    old: str,
    new: str,
    reported: str,
) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    monkeypatch.setenv("TMPDIR", str(temporary))
    broken = reworded(closed_loop_package, tmp_path / "broken.ssp", old, new)
    done = call("closed-loop", broken, "--out", tmp_path)
    assert done.exit_code == 2
    assert reported in done.stderr
    assert list(temporary.iterdir()) == [], "nothing that was unpacked is left behind"


def test_what_is_no_package_is_reported(closed_loop_package: Path, tmp_path: Path) -> None:
    (tmp_path / "text.ssp").write_text("no zip")
    old = tmp_path / "old.ssp"
    altered(closed_loop_package, old, lambda name, text: None if name == WITH_CONNECTORS else text)
    for package, said in {
        "none.ssp": "none.ssp: no such file",
        "text.ssp": "text.ssp: must be a zip archive",
        "old.ssp": f"old.ssp: has no {WITH_CONNECTORS}",
    }.items():
        told = refused("closed-loop", tmp_path / package, "--out", tmp_path)
        assert said in told
    assert "`make build` builds one" in told, "a package of an earlier version"
