"""fmpy: the host that all others are compared with."""

from __future__ import annotations

import shutil

from fmpy import extract
from fmpy.fmi2 import FMU2Slave

from slider_resonator.trials.hosts.job import Job, Rows, describe, serve


def run(job: Job) -> Rows:
    """Step the FMU through its slave."""
    description = describe(job.fmu)
    folder = extract(job.fmu)
    try:
        slave = FMU2Slave(
            instanceName="slider",
            guid=description.guid,
            modelIdentifier=description.identifier,
            unzipDirectory=folder,
        )
        slave.instantiate(loggingOn=True)
        slave.setupExperiment(startTime=0.0)
        for name, value in job.first().items():
            setter = slave.setInteger if isinstance(value, int) else slave.setReal
            setter(description.refer([name]), [value])
        slave.enterInitializationMode()
        slave.exitInitializationMode()
        inputs, outputs = description.refer(list(job.inputs)), description.refer(job.outputs)
        rows = []
        for index in range(job.steps):
            slave.setReal(inputs, [values[index] for values in job.inputs.values()])
            slave.doStep(index * job.step, job.step)
            rows.append([float(value) for value in slave.getReal(outputs)])
        slave.terminate()
        slave.freeInstance()
        return rows
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    serve(run)
