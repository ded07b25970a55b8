"""fmpy: the host that all others are compared with."""

import shutil

from fmpy import extract
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from studies.hosts.job import Description, Job, Rows, describe, serve


def run(job: Job) -> Rows:
    """Step the FMU through its slave."""
    description = describe(job.fmu)
    is_3 = description.version == "3.0"
    folder = extract(job.fmu)
    try:
        slave = (FMU3Slave if is_3 else FMU2Slave)(
            instanceName="slider",
            guid=description.guid,
            modelIdentifier=description.identifier,
            unzipDirectory=folder,
        )
        rows = (_run_3 if is_3 else _run_2)(slave, job, description)
        slave.terminate()
        slave.freeInstance()
        return rows
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _run_2(slave: FMU2Slave, job: Job, description: Description) -> Rows:
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
    return rows


def _run_3(slave: FMU3Slave, job: Job, description: Description) -> Rows:
    """Step an FMU of FMI 3.0 in event mode: to each event, and on to the end of the step."""
    slave.instantiate(loggingOn=True, eventModeUsed=True, earlyReturnAllowed=True)
    for name, value in job.first().items():
        setter = slave.setInt32 if isinstance(value, int) else slave.setFloat64
        setter(description.refer([name]), [value])
    slave.enterInitializationMode(startTime=0.0)
    slave.exitInitializationMode()
    _leave_event_mode(slave)
    inputs, outputs = description.refer(list(job.inputs)), description.refer(job.outputs)
    rows, time = [], 0.0
    for index in range(job.steps):
        slave.setFloat64(inputs, [values[index] for values in job.inputs.values()])
        end = (index + 1) * job.step
        while time < end:
            event, _, early, reached = slave.doStep(time, end - time)
            time = reached if early else end
            if event:
                slave.enterEventMode()
                _leave_event_mode(slave)
        rows.append([float(value) for value in slave.getFloat64(outputs)])
    return rows


def _leave_event_mode(slave: FMU3Slave) -> None:
    while slave.updateDiscreteStates()[0]:
        pass
    slave.enterStepMode()


if __name__ == "__main__":
    serve(run)
