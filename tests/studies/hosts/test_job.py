from __future__ import annotations

import sys
import zipfile
from pathlib import Path

import pytest

from studies.hosts.job import (
    HostAnswer,
    Job,
    Rows,
    describe,
    read_answers,
    serve,
    write_jobs,
)

JOB = Job(
    fmu="slider.fmu",
    start={"fidelity": 2, "damping_ratio": 0.1},
    inputs={"phase": [0.4, 0.9], "load": [0.0, 0.05]},
    step=1e-3,
    outputs=["velocity"],
)


def test_start_values_are_parameters_and_the_first_inputs() -> None:
    assert JOB.first() == {"fidelity": 2, "damping_ratio": 0.1, "phase": 0.4, "load": 0.0}
    assert JOB.steps == 2


def served(
    run: object, jobs: list[Job], folder: Path, monkeypatch: pytest.MonkeyPatch
) -> list[HostAnswer]:
    asked, answered = folder / "jobs.json", folder / "answers.jsonl"
    write_jobs(asked, jobs)
    monkeypatch.setattr(sys, "argv", ["host", str(asked), str(answered)])
    serve(run)  # type: ignore[arg-type]
    return read_answers(answered)


def test_jobs_and_answers_survive_the_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []

    def run(job: Job) -> Rows:
        seen.append(job)
        return [[0.1 + 0.2, -1e-300]]

    assert (
        served(run, [JOB, JOB], tmp_path, monkeypatch) == [HostAnswer([[0.1 + 0.2, -1e-300]])] * 2
    )
    assert seen == [JOB, JOB]
    assert isinstance(seen[0].start["fidelity"], int), "Integers stay integers"


def test_an_error_answers_its_own_job_only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    numbers = iter(range(2))

    def run(job: Job) -> Rows:
        if next(numbers) == 0:
            raise ValueError("load = nan refused")
        return [[1.0]]

    assert served(run, [JOB, JOB], tmp_path, monkeypatch) == [
        HostAnswer([], "ValueError: load = nan refused"),
        HostAnswer([[1.0]]),
    ]


def test_no_file_is_no_answer(tmp_path: Path) -> None:
    assert read_answers(tmp_path / "none.jsonl") == []


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
    description = describe(str(fmu))
    assert description.version == version
    assert (description.guid, description.identifier) == ("g", "i")
    assert description.refer(["b", "a"]) == [3, 7]
