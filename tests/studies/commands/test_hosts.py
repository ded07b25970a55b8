from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.finished import FMUS
from studies.commands import hosts
from studies.hosts.hosts import hosts as all_hosts
from tests.harness.calling import call
from tests.harness.public_json import assert_public_keys

FMPY = ("--host", "fmpy")


@pytest.fixture
def others(python_fmu: Path, native_3_fmu: Path) -> tuple[str | Path, ...]:
    """The options that name the other FMUs."""
    return "--python-fmu", python_fmu, "--fmi3-fmu", native_3_fmu


@pytest.mark.slow
def test_the_reference_agrees_with_itself(
    native_fmu: Path, others: tuple[str | Path, ...], tmp_path: Path
) -> None:
    out = tmp_path / "hosts.md"
    done = call("hosts", native_fmu, *others, *FMPY, "--out", out, "--json")
    assert done.exit_code == 0, done.output
    assert_public_keys("hosts", done.stdout)
    results = json.loads(done.stdout)
    assert [(result["host"], result["fmu"]) for result in results] == [
        ("fmpy", "native"),
        ("fmpy", "Python"),
        ("fmpy", "native, FMI 3.0"),
    ]
    for result in results[:2]:
        assert [case["deviation"] for case in result["cases"]] == [0.0] * 6
    assert max(case["deviation"] for case in results[2]["cases"]) <= 1e-13
    assert out.read_text().count("| 0 | 0 | 0 | 0 | 0 | 0 |") == 2


def test_the_fmu_is_given_once(native_fmu: Path) -> None:
    assert "must be one FMU" in call("hosts", native_fmu, "--fmu", native_fmu).stderr


def test_an_fmu_that_fmpy_cannot_run_is_no_verdict(
    others: tuple[str | Path, ...], tmp_path: Path
) -> None:
    broken = tmp_path / "broken.fmu"
    broken.write_bytes(b"no zip")
    done = call("hosts", broken, *others, *FMPY)
    assert done.exit_code == 2
    assert f"{broken}: does not run in fmpy: BadZipFile" in done.stderr


def test_a_host_that_fails_is_a_verdict(
    native_fmu: Path,
    others: tuple[str | Path, ...],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
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
    native_fmu: Path, others: tuple[str | Path, ...], tmp_path: Path
) -> None:
    out = tmp_path / "hosts.md"
    done = call(
        "hosts",
        *(native_fmu, *others, "--host", "cofmupy"),
        *("--own-environments", tmp_path / "nowhere", "--out", out, "--json"),
    )
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


@pytest.mark.slow
def test_what_is_installed_runs_and_the_rest_is_listed(
    native_fmu: Path, others: tuple[str | Path, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    fmpy = all_hosts()[0]

    def missing() -> str:
        raise HarnessError("matlab: not installed")

    two = (fmpy, replace(fmpy, name="matlab", version=missing))
    monkeypatch.setattr(hosts, "hosts", lambda *_: two)
    monkeypatch.setattr(hosts, "NAMES", [host.name for host in two])
    done = call("hosts", native_fmu, *others)
    assert done.exit_code == 0, done.output
    assert done.stderr == "not run: matlab: matlab: not installed\n"
    assert "fmpy" in done.stdout


@pytest.mark.slow
def test_the_fmus_of_the_installation_run_where_nothing_is_built(
    native_fmu: Path,
    others: tuple[str | Path, ...],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    installed = tmp_path / "finished"
    installed.mkdir()
    for fmu, name in zip((native_fmu, others[1], others[3]), FMUS.values(), strict=True):
        (installed / name).symlink_to(fmu)
    monkeypatch.setattr(hosts, "COMMANDS_LOOK_IN", (installed,))
    monkeypatch.chdir(tmp_path)
    done = call("hosts", native_fmu, *FMPY)
    assert done.exit_code == 0, done.output
