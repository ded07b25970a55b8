"""ecos: a C++ master behind a Python interface; loads FMUs of FMI 2.0 and 3.0."""

import ctypes
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from studies.hosts.job import Job, Rows, serve

SLIDER = "slider"


def preload_tbb() -> None:
    """Load the library that ecos links against from where its package puts it.

    The loader of the system looks into no Python environment.
    """
    for library in sorted(Path(sys.prefix).glob("lib/libtbb.so.*")):
        ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
        return


def run(job: Job) -> Rows:
    """Step a simulation with one FMU; parameters are a parameter set, inputs are set by name."""
    preload_tbb()
    from ecospy import EcosSimulation, EcosSimulationStructure

    with EcosSimulationStructure() as structure:
        structure.add_model(SLIDER, job.fmu)
        values = {f"{SLIDER}::{name}": value for name, value in job.first().items()}
        structure.add_parameter_set("start", values)
        with EcosSimulation(step_size=job.step, structure=structure) as simulation:
            if not simulation.init(parameter_set="start"):
                raise RuntimeError("ecos could not initialise the FMU")
            inputs, outputs = (
                [f"{SLIDER}::{name}" for name in names] for names in (job.inputs, job.outputs)
            )
            return stepped(simulation, job, inputs, outputs)


def stepped(simulation: Any, job: Job, inputs: Sequence[str], outputs: Sequence[str]) -> Rows:
    """Take the steps of a job and end; `inputs` and `outputs` are in the order of the job's."""
    rows = []
    for index in range(job.steps):
        for name, held in zip(inputs, job.inputs.values(), strict=True):
            simulation.set_real(name, held[index])
        simulation.step()
        rows.append([simulation.get_real(name) for name in outputs])
    simulation.terminate()
    return rows


if __name__ == "__main__":
    serve(run)
