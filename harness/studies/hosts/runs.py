"""Table 1 in a host, at each fidelity and with each friction law, compared with fmpy."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np

from slider_resonator.device.interface import OUTPUTS
from slider_resonator.errors import HarnessError
from slider_resonator.output.files import temporary_folder
from studies.hosts.hosts import Host
from studies.hosts.job import HostAnswer, Job, Rows, read_answers, write_jobs
from studies.hosts.program import run_program

STEP, STEPS = 1e-3, 40

TIME_LIMIT = 600.0
"""Time limit of all cases in a host, s: the first cross-compilation builds a C library."""

FMI_3 = "native, FMI 3.0"
"""The FMU that is compared with that of FMI 2.0."""

MAX_PRINTED = 1000
"""Maximum characters of a crashed host's output in the message."""

ALLOWED = 1e-11
"""Largest allowed deviation from fmpy, relative to each signal's peak: hosts round communication
points differently, other platforms also sine and exponential."""


@dataclass(frozen=True)
class Case:
    """A case that the hosts run: a friction law at a fidelity."""

    friction_law: int
    fidelity: int

    @property
    def title(self) -> str:
        """Law and fidelity in words."""
        return f"{('Coulomb', 'LuGre')[self.friction_law]} {self.fidelity}"


CASES = tuple(Case(law, fidelity) for law in (0, 1) for fidelity in (2, 1, 0))


@dataclass(frozen=True)
class HostComparison:
    """A host's run against fmpy's: largest deviation in shares of peak, or an error."""

    deviation: float | None
    error: str | None = None

    @property
    def passed(self) -> bool:
        """Whether the host ran it and agrees."""
        return self.deviation is not None and self.deviation <= ALLOWED


@dataclass(frozen=True)
class HostResult:
    """One FMU in one host."""

    host: str
    version: str
    fmu: str
    comparisons: Mapping[Case, HostComparison]

    @property
    def passed(self) -> bool:
        """Whether all cases ran and agree."""
        return all(comparison.passed for comparison in self.comparisons.values())


def table_1_jobs(fmu: Path) -> list[Job]:
    """Return a job per case: 40 steps of 1 ms in which each input changes once."""
    quarter = STEPS // 4
    inputs = {
        "phase": [0.4] * quarter + [0.9] * (STEPS - quarter),
        "load": [0.0] * 2 * quarter + [0.05] * (STEPS - 2 * quarter),
        "frequency_ratio": [1.0] * 3 * quarter + [3.0] * (STEPS - 3 * quarter),
    }
    return [
        Job(
            fmu=str(fmu.resolve()),
            start={"fidelity": case.fidelity, "friction_law": case.friction_law},
            inputs=inputs,
            step=STEP,
            outputs=tuple(OUTPUTS),
        )
        for case in CASES
    ]


def run_jobs(host: Host, jobs: Sequence[Job], time_limit: float = TIME_LIMIT) -> list[HostAnswer]:
    """Run jobs in a host, in a process of its own, and return one answer for each.

    Where the host crashed or exceeded `time_limit` (s), the missing answers are errors that say so.
    """
    with temporary_folder() as folder:
        todo, done, log = (folder / name for name in ("jobs.json", "answers.jsonl", "printed.txt"))
        write_jobs(todo, jobs)
        # Else a link would stand for the interpreter that it leads to, without its packages.
        python = os.path.abspath(host.python)
        command = [python, "-P", "-m", f"studies.hosts.{host.module}"]
        end = run_program([*command, str(todo), str(done)], folder, log, time_limit)
        answers = read_answers(done)
        printed = log.read_text(errors="replace").strip()[-MAX_PRINTED:]
    missing = len(jobs) - len(answers)
    return answers + [HostAnswer([], f"the host {end}: {printed}")] * missing


def coupled(jobs: Sequence[Job], leaders: Sequence[Rows]) -> list[Job]:
    """Return the jobs with the leader's blocking force as load."""
    column = list(OUTPUTS).index("blocking_force")
    return [
        replace(job, inputs={**job.inputs, "load": [row[column] for row in rows]})
        for job, rows in zip(jobs, leaders, strict=True)
    ]


def compare(ours: Rows, theirs: HostAnswer) -> HostComparison:
    """Compare a host's answer with fmpy's rows, `ours`."""
    if theirs.error is not None:
        return HostComparison(None, theirs.error)
    expected, found = np.asarray(ours), np.asarray(theirs.rows)
    if expected.shape != found.shape:
        return HostComparison(None, f"{found.shape} values, not {expected.shape}")
    peaks = np.abs(expected).max(axis=0)
    deviations = np.abs(found - expected).max(axis=0) / np.where(peaks > 0.0, peaks, 1.0)
    return HostComparison(float(np.max(deviations)))


def run_host(
    host: Host,
    reference: Host,
    native: Path,
    python: Path,
    native_3: Path,
    time_limit: float = TIME_LIMIT,
) -> list[HostResult]:
    """Run table 1 in `host` with each FMU that it can load, and compare with `reference`.

    `native_3`, of FMI 3.0, is compared with `native`, of FMI 2.0. Raises HarnessError where the
    host is missing, or an FMU does not run in `reference`.
    """
    version = host.version()
    if host.couples:
        jobs = table_1_jobs(native)
        leaders = _table_1_in_reference(reference, python, time_limit)
        ours = _run_in_reference(reference, coupled(jobs, leaders), time_limit)
        behind = [replace(job, partner=str(python.resolve())) for job in jobs]
        theirs = run_jobs(host, behind, time_limit)
        return [HostResult(host.name, version, "native behind Python", by_case(ours, theirs))]
    pairs = [("native", native, native)]
    pairs += [("Python", python, python)] if host.loads_python else []
    pairs += [(FMI_3, native_3, native)] if host.loads_fmi_3 else []
    results = []
    for name, fmu, in_reference in pairs:
        ours = _table_1_in_reference(reference, in_reference, time_limit)
        compared = by_case(ours, run_jobs(host, table_1_jobs(fmu), time_limit))
        results.append(HostResult(host.name, version, name, compared))
    return results


@cache
def _table_1_in_reference(reference: Host, fmu: Path, time_limit: float) -> list[Rows]:
    """Return the rows that each host is compared with."""
    return _run_in_reference(reference, table_1_jobs(fmu), time_limit)


def by_case(ours: Sequence[Rows], theirs: Sequence[HostAnswer]) -> dict[Case, HostComparison]:
    """Compare answers to the jobs of all cases with fmpy's rows."""
    pairs = zip(ours, theirs, strict=True)
    return dict(zip(CASES, (compare(*pair) for pair in pairs), strict=True))


def _run_in_reference(reference: Host, jobs: Sequence[Job], time_limit: float) -> list[Rows]:
    answers = run_jobs(reference, jobs, time_limit)
    for job, answer in zip(jobs, answers, strict=True):
        if answer.error is not None:
            raise HarnessError(f"{job.fmu}: does not run in {reference.name}: {answer.error}")
    return [answer.rows for answer in answers]
