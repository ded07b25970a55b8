import json
import zipfile
from pathlib import Path

import pytest

from slider_resonator.fmu.finished import FMUS
from studies.commands import bench
from studies.hosts.step_cost import STEPS, StepCost
from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys

Arguments = tuple[str | Path, ...]


@pytest.fixture
def others(python_fmu: Path, native_3_fmu: Path) -> Arguments:
    """The options that name the other FMUs."""
    return "--python-fmu", python_fmu, "--fmi3-fmu", native_3_fmu


def test_an_fmu_that_fmpy_cannot_run_is_no_verdict(others: Arguments, tmp_path: Path) -> None:
    broken = tmp_path / "broken.fmu"
    zipfile.ZipFile(broken, "w").close()
    done = call("hosts", broken, *others, "--host", "fmpy")
    assert done.exit_code == 2
    assert f"{broken}: does not run in fmpy: KeyError" in done.stderr


def test_a_host_that_fails_is_a_verdict(
    native_fmu: Path, others: Arguments, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("CC", str(tmp_path / "no compiler"))
    monkeypatch.setattr("studies.hosts.hosts.compiler_version", lambda _: "none")
    out = tmp_path / "hosts.md"
    done = call("hosts", native_fmu, *others, "--host", "C driver", "--out", out)
    assert done.exit_code == 1
    assert "FAIL" in done.stdout
    assert "C driver, native FMU, Coulomb 2: FileNotFoundError" in done.stdout
    assert out.read_text().count("**failed**") == 6, "the table does not hide it"


def test_hosts_that_are_not_installed_are_no_verdict(
    native_fmu: Path, others: Arguments, tmp_path: Path
) -> None:
    out = tmp_path / "hosts.md"
    nowhere = ("--own-environments", tmp_path / "nowhere")
    done = call("hosts", native_fmu, *others, *nowhere, "--host", "cofmupy", "--out", out, "--json")
    assert done.exit_code == 2
    assert "cofmupy: there is no" in json.loads(done.stdout)["error"]
    assert not out.exists(), "a table that lacks a host is not written"


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        (["--host", "matlab"], "'matlab' is not one of"),
        (["no_such.fmu"], "no_such.fmu"),
        (["--out", "hosts.txt"], "must be one of .md"),
    ],
)
def test_bad_arguments_are_refused(
    arguments: list[str], reported: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "dist").mkdir()
    for name in FMUS.values():
        (tmp_path / "dist" / name).touch()
    monkeypatch.chdir(tmp_path)
    done = call("hosts", *arguments)
    assert done.exit_code == 2
    assert reported in done.stderr


def test_costs_are_printed_and_returned_as_json(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    costs = tuple(StepCost(s.name, len(s.outputs), 1.03, 1.01, 1.25) for s in STEPS)
    monkeypatch.setattr(bench, "measure_steps", lambda *_: costs)
    text = call("bench", native_fmu).stdout
    assert "resolved Coulomb, 1 ms" in text
    assert "1.01-1.25" in text
    assert "100.00 times" in text
    assert "cost 1 times less" in text
    printed = call("bench", native_fmu, "--json").stdout
    assert_public_keys("bench", printed)
    assert json.loads(printed)["c_host"][0] == vars(costs[0])


def test_an_fmu_that_needs_python_is_refused(python_fmu: Path) -> None:
    assert "needs a Python interpreter" in refused("bench", python_fmu)
