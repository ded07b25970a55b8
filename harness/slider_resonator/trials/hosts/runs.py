"""Table 1 in a host, at each fidelity and with each friction law, compared with fmpy."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from slider_resonator.device.interface import OUTPUTS
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.process_group import end_group
from slider_resonator.fmu.isolation.temporary_files import temporary_files_in
from slider_resonator.trials.hosts.hosts import Host
from slider_resonator.trials.hosts.job import Answer, Job, Rows, read_answers, write_jobs

STEP, STEPS = 1e-3, 40

TIME_LIMIT = 600.0
"""For all cases in a host [s]: the first cross-compilation on a machine builds a C library."""

ALLOWED = 1e-11
"""Largest deviation from fmpy, in shares of each signal's peak: communication points and, on
another platform, sine and exponential are rounded differently."""


@dataclass(frozen=True)
class Case:
    """What the hosts run: a friction law at a fidelity."""

    friction_law: int
    fidelity: int

    @property
    def title(self) -> str:
        """Law and fidelity in words."""
        return f"{('Coulomb', 'LuGre')[self.friction_law]} {self.fidelity}"


CASES = tuple(Case(law, fidelity) for law in (0, 1) for fidelity in (2, 1, 0))


@dataclass(frozen=True)
class Comparison:
    """A host's run against fmpy's: largest deviation in shares of peak, or what went wrong."""

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
    comparisons: Mapping[Case, Comparison]

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


def ask(host: Host, jobs: Sequence[Job]) -> list[Answer]:
    """Run jobs in a host, in a process of its own, and return one answer for each.

    Where the host died, or did not end within `TIME_LIMIT` (s), the answers it did not give say so.
    """
    with tempfile.TemporaryDirectory(
        prefix="slider-resonator-", ignore_cleanup_errors=True
    ) as name:
        asked, answered, said = (Path(name, f) for f in ("jobs.json", "answers.jsonl", "said.txt"))
        write_jobs(asked, jobs)
        command = [str(host.python), "-P", "-m", f"slider_resonator.trials.hosts.{host.module}"]
        code = _run([*command, str(asked), str(answered)], said)
        answers = read_answers(answered)
        end = f"ended after {TIME_LIMIT:g} s" if code is None else f"ended with {code}"
        last_words = said.read_text(errors="replace").strip()[-1000:]
    missing = len(jobs) - len(answers)
    return answers + [Answer([], f"the host {end}: {last_words}")] * missing


def _run(command: Sequence[str], said: Path) -> int | None:
    """Run a host to its end, or end it and what it started; return its exit code or None.

    What it says goes to the file `said`: pipes would stay open as long as any process it started.
    """
    with said.open("wb") as log:
        process = subprocess.Popen(
            command,
            env={
                **os.environ,
                # Hosts leave what they have unpacked where it is when an FMU fails.
                **temporary_files_in(str(said.parent)),
                "PYTHONPATH": str(Path(__file__).resolve().parents[3]),
            },
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            start_new_session=True,
        )
        try:
            return process.wait(TIME_LIMIT)
        except subprocess.TimeoutExpired:
            return None
        finally:
            if process.poll() is None:
                end_group(process)


def coupled(jobs: Sequence[Job], leaders: Sequence[Rows]) -> list[Job]:
    """Return the jobs with the leader's blocking force as load."""
    column = list(OUTPUTS).index("blocking_force")
    return [
        replace(job, inputs={**job.inputs, "load": [row[column] for row in rows]})
        for job, rows in zip(jobs, leaders, strict=True)
    ]


def compare(ours: Rows, theirs: Answer) -> Comparison:
    """Compare a host's answer with fmpy's rows, `ours`."""
    if theirs.error is not None:
        return Comparison(None, theirs.error)
    expected, found = np.asarray(ours), np.asarray(theirs.rows)
    if expected.shape != found.shape:
        return Comparison(None, f"{found.shape} values, not {expected.shape}")
    peaks = np.abs(expected).max(axis=0)
    deviations = np.abs(found - expected).max(axis=0) / np.where(peaks > 0.0, peaks, 1.0)
    return Comparison(float(np.max(deviations)))


def run_host(host: Host, reference: Host, native: Path, python: Path) -> list[HostResult]:
    """Run table 1 in `host` with each FMU that it can load, and compare with `reference`.

    Raises HarnessError where the host is missing, or an FMU does not run in `reference`.
    """
    version = host.version()
    if host.couples:
        jobs = table_1_jobs(native)
        leaders = _ask_reference(reference, table_1_jobs(python))
        ours = _ask_reference(reference, coupled(jobs, leaders))
        theirs = ask(host, [replace(job, partner=str(python.resolve())) for job in jobs])
        return [HostResult(host.name, version, "native behind Python", by_case(ours, theirs))]
    results = []
    for name, fmu in (("native", native), ("Python", python)):
        if name == "native" or host.loads_python:
            jobs = table_1_jobs(fmu)
            compared = by_case(_ask_reference(reference, jobs), ask(host, jobs))
            results.append(HostResult(host.name, version, name, compared))
    return results


def by_case(ours: Sequence[Rows], theirs: Sequence[Answer]) -> dict[Case, Comparison]:
    """Compare answers to the jobs of all cases with fmpy's rows."""
    pairs = zip(ours, theirs, strict=True)
    return dict(zip(CASES, (compare(*pair) for pair in pairs), strict=True))


def _ask_reference(reference: Host, jobs: Sequence[Job]) -> list[Rows]:
    answers = ask(reference, jobs)
    for job, answer in zip(jobs, answers, strict=True):
        if answer.error is not None:
            raise HarnessError(f"{job.fmu}: does not run in {reference.name}: {answer.error}")
    return [answer.rows for answer in answers]
