"""Hosts: what is missing is named, and their answers are compared."""

import math
import re
import sys
import zipfile
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from studies.hosts.driver_host import native_driver
from studies.hosts.hosts import Host, hosts, package_version
from studies.hosts.job import HostAnswer, Job, Rows, describe, read_answers, serve, write_jobs
from studies.hosts.runs import ALLOWED, CASES, FMI_3, compare, run_jobs, table_1_jobs
from studies.hosts.step_cost import (
    LONG_STEP,
    ONE_PERIOD,
    STEPS,
    StepCost,
    leap_gains,
    measure_steps,
    short_step_ratio,
)
from studies.hosts.table import BEGIN, COLUMNS, END
from tests.native.toolchain import run, unpacked_binary
from tests.processes import ROOT, has_ended


def test_a_package_that_is_missing_is_named_with_what_installs_it() -> None:
    with pytest.raises(HarnessError, match=r"no-such-host: not installed.*`make hosts`"):
        package_version("no-such-host")


@pytest.mark.parametrize(
    ("guid", "commands", "code", "message"),
    [
        (None, "initialize\nstep -1.0 1", 1, "communicationStepSize = -1.0 refused"),
        (None, "real 999 1.0", 1, "999"),
        (None, "leap", 2, "leap is no command"),
        (None, "step 0.001 many", 2, "many is not a number"),
        ("another", "", 1, "fmuGUID = 'another' refused"),
    ],
)
def test_the_driver_reports_errors(
    native_fmu: Path, tmp_path: Path, guid: str | None, commands: str, code: int, message: str
) -> None:
    binary = unpacked_binary(native_fmu, tmp_path)
    done = run([native_driver(), binary.library, guid or binary.guid, "file:///"], f"{commands}\n")
    assert done.returncode == code
    assert message in done.stderr
    usage = run([native_driver()])
    assert usage.returncode == 2
    assert "usage: driver LIBRARY GUID RESOURCES" in usage.stderr


JOB = Job(
    fmu="slider.fmu",
    start={"fidelity": 2, "damping_ratio": 0.1},
    inputs={"phase": [0.4, 0.9], "load": [0.0, 0.05]},
    step=1e-3,
    outputs=["velocity"],
)


def test_jobs_and_answers_survive_the_files_and_an_error_is_of_its_own_job_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []

    def run(job: Job) -> Rows:
        seen.append(job)
        if len(seen) == 1:
            raise ValueError("load = nan refused")
        return [[0.1 + 0.2, -1e-300]]

    asked, answered = tmp_path / "jobs.json", tmp_path / "answers.jsonl"
    write_jobs(asked, [JOB, JOB])
    monkeypatch.setattr(sys, "argv", ["host", str(asked), str(answered)])
    serve(run)
    assert read_answers(answered) == [
        HostAnswer([], "ValueError: load = nan refused"),
        HostAnswer([[0.1 + 0.2, -1e-300]]),
    ]
    assert seen == [JOB, JOB]
    assert isinstance(seen[0].start["fidelity"], int), "Integers stay integers"


@pytest.mark.parametrize(
    ("version", "token", "tag"),
    [("2.0", "guid", "ScalarVariable"), ("3.0", "instantiationToken", "Float64")],
)
def test_a_description_is_read_without_any_package(
    tmp_path: Path, version: str, token: str, tag: str
) -> None:
    fmu = tmp_path / "some.fmu"
    with zipfile.ZipFile(fmu, "w") as archive:
        archive.writestr(
            "modelDescription.xml",
            f'<fmiModelDescription fmiVersion="{version}" {token}="g">'
            '<CoSimulation modelIdentifier="i"/><ModelVariables>'
            f'<{tag} name="a" valueReference="7"/>'
            f'<{tag} name="b" valueReference="3"/></ModelVariables></fmiModelDescription>',
        )
    found = describe(str(fmu))
    assert (found.version, found.guid, found.identifier) == (version, "g", "i")
    assert found.refer(["b", "a"]) == [3, 7]


FMU = Path("some.fmu")


def host(folder: Path, script: str) -> Host:
    """A host whose interpreter is a shell script with the arguments -P -m MODULE JOBS ANSWERS."""
    program = folder / "host"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    return Host("broken", "broken_host", lambda: "1", program)


def test_a_host_that_dies_leaves_the_answers_before(tmp_path: Path) -> None:
    answer = '{"rows": [[1.0]], "error": null}'
    broken = host(tmp_path, f"echo '{answer}' > \"$5\"; echo 'cannot go on' >&2; exit 3")
    first, second, *_ = answers = run_jobs(broken, table_1_jobs(FMU))
    assert len(answers) == len(CASES)
    assert first == HostAnswer([[1.0]])
    assert second.error == "the host ended with 3: cannot go on"


def test_a_host_that_hangs_is_ended_with_all_it_started(tmp_path: Path) -> None:
    pid_file = tmp_path / "pid"
    hanging = host(tmp_path, f"sleep 600 & echo $! > {pid_file}; wait")
    (answer,) = run_jobs(hanging, table_1_jobs(FMU)[:1], time_limit=2.0)
    assert answer.error is not None
    assert answer.error.startswith("the host was ended after 2 s")
    assert has_ended(int(pid_file.read_text()))


OURS = [[2.0, 0.0], [-4.0, 0.0]]


@pytest.mark.parametrize(
    ("answer", "deviation", "error"),
    [
        (HostAnswer(OURS), 0.0, None),
        (HostAnswer([[2.0, 0.0], [-4.0, 1e-12]]), 1e-12, None),  # without peak as it is
        (HostAnswer([[2.0 + 1e-9, 0.0], [-4.0, 0.0]]), 2.5e-10, None),
        (HostAnswer([[math.nan, 0.0]] * 2), math.nan, None),
        (HostAnswer([[1.0, 0.0]]), None, "(1, 2) values, not (2, 2)"),
        (HostAnswer([], "load = nan refused"), None, "load = nan refused"),
    ],
)
def test_deviations_count_in_shares_of_each_peak(
    answer: HostAnswer, deviation: float | None, error: str | None
) -> None:
    found = compare(OURS, answer)
    assert found.error == error
    assert found.deviation == pytest.approx(deviation, nan_ok=True)
    assert found.passed == (deviation is not None and deviation <= ALLOWED == 1e-11)


def test_the_table_of_the_page_is_one_that_this_code_writes() -> None:
    text = (ROOT / "docs" / "hosts.md").read_text(encoding="utf-8")
    between = text.partition(BEGIN)[2].partition(END)[0].strip().splitlines()
    head, _, *rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in between]
    assert head == [column.heading for column in COLUMNS]
    found: dict[str, list[str]] = {}
    for name, version, fmu, *deviations in rows:
        assert version, f"the version of {name} is missing"
        assert len(deviations) == len(CASES)
        for deviation in deviations:
            assert re.fullmatch(r"0|\de-\d\d", deviation), f"{name}: {deviation} is no agreement"
        found.setdefault(name, []).append(fmu)
    assert list(found) == [host.name for host in hosts()]
    for host in hosts():
        fmus = ["native", "Python"] if host.loads_python else ["native"]
        fmus += [FMI_3] if host.loads_fmi_3 else []
        assert found[host.name] == (["native behind Python"] if host.couples else fmus)


@pytest.mark.slow
def test_every_step_is_timed(native_fmu: Path) -> None:
    costs = measure_steps(native_fmu, 1, lambda name, share: None, 60.0)
    assert [cost.name for cost in costs] == [step.name for step in STEPS]
    assert all(0.0 < cost.fastest <= cost.microseconds <= cost.slowest for cost in costs)
    assert min(leap_gains(costs)) > 5.0


def test_short_steps_are_compared_with_long_ones_per_period() -> None:
    short = StepCost(ONE_PERIOD, 1, microseconds=0.9, fastest=0.6, slowest=2.0)
    long = StepCost(LONG_STEP, 1, microseconds=70.0, fastest=50.0, slowest=90.0)
    assert short_step_ratio([short, long]) == pytest.approx(1.2)
