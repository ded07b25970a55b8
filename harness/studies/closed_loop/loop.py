"""One run of the closed loop in a host, at one fidelity."""

import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy.ssp.ssd import read_ssv

from slider_resonator.arrays import Array
from slider_resonator.errors import HarnessError
from studies.closed_loop.duty import Duty
from studies.hosts.hosts import Host, packaged
from studies.hosts.job import Job
from studies.hosts.runs import TIME_LIMIT, run_jobs
from studies.hosts.ssp_package import WITH_CONNECTORS

DESIGN, PROOF = "design", "proof"
"""The parameter sets in the package: averaged motion, and the full device."""
FIDELITY = "slider.fidelity"
OUTPUTS = ("slider.mean_velocity", "controller.phase")

HOSTS = (
    packaged("fmpy", "fmpy_ssp_host", "fmpy"),
    packaged("libcosimpy", "libcosim_ssp_host", "libcosimpy"),
    packaged("ecos", "ecos_ssp_host", "ecospy"),
)

INPUT_DELAY = {"fmpy": 1, "libcosimpy": 0, "ecos": 0}
"""Communication steps after which inputs of the system reach the components."""


@dataclass(frozen=True)
class LoopRecord:
    """Mean velocity (m/s) and phase (rad) at the ends of the communication steps, shapes (n,).

    The phase is the one that the controller puts out: the slider has it in the step after. `load`
    (N) is what the slider had in the step.
    """

    host: str
    fidelity: int
    times: Array
    velocity: Array
    phase: Array
    load: Array


def run_loop(
    package: Path, host: Host, duty: Duty, time_limit: float = TIME_LIMIT
) -> tuple[LoopRecord, LoopRecord]:
    """Run the loop at the fidelity of the design and at that of the proof.

    The host is a process of its own, which may take `time_limit` (s). Raises HarnessError where it
    is missing or cannot run.
    """
    host.version()
    jobs = [_job(package, name, duty) for name in (DESIGN, PROOF)]
    with zipfile.ZipFile(package) as archive:
        if WITH_CONNECTORS not in archive.namelist():
            raise HarnessError(
                f"{package}: has no {WITH_CONNECTORS}, the structure with system inputs; "
                "must be a package of version 0.2.0 or later: `make build` builds one"
            )
    records = []
    for job, answer in zip(jobs, run_jobs(host, jobs, time_limit), strict=True):
        if answer.error is not None:
            raise HarnessError(f"{package} does not run in {host.name}: {answer.error}")
        rows = np.array(answer.rows, dtype=np.float64)
        if rows.shape != (job.steps, len(OUTPUTS)) or not np.isfinite(rows).all():
            raise HarnessError(
                f"{package} in {host.name}: {rows.shape} values, must be "
                f"{(job.steps, len(OUTPUTS))}, all finite"
            )
        times = duty.step * np.arange(1.0, job.steps + 1.0)
        fidelity = int(job.start[FIDELITY])
        late = INPUT_DELAY[host.name] * duty.step
        load = np.array([duty.load(time - late) for time in duty.times])
        records.append(LoopRecord(host.name, fidelity, times, rows[:, 0], rows[:, 1], load))
    return records[0], records[1]


def _job(package: Path, name: str, duty: Duty) -> Job:
    return Job(
        fmu=str(package.resolve()),
        start=parameters(package, name),
        inputs={
            "velocity_reference": [duty.reference] * len(duty.times),
            "load": [duty.load(time) for time in duty.times],
        },
        step=duty.step,
        outputs=OUTPUTS,
    )


def parameters(package: Path, name: str) -> dict[str, float]:
    """Return the values of a parameter set in the package, Integers as int.

    Raises HarnessError where there is no such set, or it says nothing of the fidelity.
    """
    try:
        found = read_ssv(str(package), resource=f"resources/{name}.ssv").parameters
    except Exception as error:  # zipfile, lxml and fmpy each raise their own
        raise HarnessError(f"{package}: no parameter set {name} can be read: {error}") from error
    values = {p.name: int(p.value) if p.type == "Integer" else float(p.value) for p in found}
    if FIDELITY not in values:
        raise HarnessError(f"{package}: parameter set {name} lacks {FIDELITY}")
    return values
