from __future__ import annotations

import math
from pathlib import Path

import pytest

from slider_resonator.device.interface import INPUTS, OUTPUTS
from studies.hosts.hosts import Host
from studies.hosts.job import HostAnswer
from studies.hosts.runs import (
    ALLOWED,
    CASES,
    compare,
    coupled,
    run_jobs,
    table_1_jobs,
)
from tests.processes import has_ended

FMU = Path("some.fmu")


def host(folder: Path, script: str) -> Host:
    """A host whose interpreter is a shell script with the arguments -P -m MODULE JOBS ANSWERS."""
    program = folder / "host"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    return Host("broken", "broken_host", lambda: "1", program)


def test_every_case_is_run_and_every_input_changes() -> None:
    jobs = table_1_jobs(FMU)
    assert {(job.start["friction_law"], job.start["fidelity"]) for job in jobs} == {
        (law, fidelity) for law in (0, 1) for fidelity in (0, 1, 2)
    }
    for job in jobs:
        assert list(job.inputs) == list(INPUTS)
        assert all(len(set(values)) == 2 for values in job.inputs.values())
        assert {len(values) for values in job.inputs.values()} == {job.steps}
        assert list(job.outputs) == list(OUTPUTS)


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


def test_deviations_count_in_shares_of_each_peak() -> None:
    ours = [[2.0, 0.0], [-4.0, 0.0]]
    assert compare(ours, HostAnswer(ours)).deviation == 0.0
    other = compare(ours, HostAnswer([[2.0, 0.0], [-4.0, 1e-12]]))
    assert other.deviation == 1e-12, "a signal without peak counts as it is"
    assert other.passed
    wrong = compare(ours, HostAnswer([[2.0 + 1e-9, 0.0], [-4.0, 0.0]]))
    assert wrong.deviation == pytest.approx(2.5e-10)
    assert not wrong.passed
    assert ALLOWED == 1e-11


def test_an_answer_that_cannot_be_compared_fails() -> None:
    refused = compare([[1.0]], HostAnswer([], "load = nan refused"))
    assert refused.error == "load = nan refused"
    short = compare([[1.0], [2.0]], HostAnswer([[1.0]]))
    assert short.error == "(1, 1) values, not (2, 1)"
    not_a_number = compare([[1.0]], HostAnswer([[math.nan]]))
    assert not any(found.passed for found in (refused, short, not_a_number))


def test_the_leaders_blocking_force_becomes_the_load() -> None:
    jobs = table_1_jobs(FMU)[:1]
    row = [0.0] * len(OUTPUTS)
    row[list(OUTPUTS).index("blocking_force")] = 0.07
    (job,) = coupled(jobs, [[row] * jobs[0].steps])
    assert set(job.inputs["load"]) == {0.07}
    assert job.inputs["phase"] == jobs[0].inputs["phase"]
