"""libcosimpy: the C++ co-simulation library of the Open Simulation Platform."""

from __future__ import annotations

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from slider_resonator.trials.hosts.job import Job, Rows, describe, serve

NANOSECONDS = 1e9


def run(job: Job) -> Rows:
    """Step an execution with one slave whose inputs an override manipulator sets."""
    description = describe(job.fmu)
    execution = CosimExecution.from_step_size(round(job.step * NANOSECONDS))
    slave = execution.add_local_slave(CosimLocalSlave(job.fmu, "slider"))
    if slave < 0:
        raise RuntimeError("libcosim could not load the FMU")
    for name, value in job.first().items():
        (reference,) = description.refer([name])
        set_initial(execution, slave, reference, name, value)
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    inputs, outputs = description.refer(list(job.inputs)), description.refer(job.outputs)
    rows = []
    for index in range(job.steps):
        values = [values[index] for values in job.inputs.values()]
        manipulator.slave_real_values(slave, inputs, values)
        if not execution.step():
            raise RuntimeError(f"libcosim could not take step {index + 1}")
        rows.append([float(value) for value in observer.last_real_values(slave, outputs)])
    return rows


def set_initial(
    execution: CosimExecution, slave: int, reference: int, name: str, value: float
) -> None:
    """Set a value before initialisation, an Integer where it is an int; RuntimeError if refused."""
    if isinstance(value, int):
        taken = execution.integer_initial_value(slave, reference, value)
    else:
        taken = execution.real_initial_value(slave, reference, value)
    if not taken:
        raise RuntimeError(f"libcosim did not take {name} = {value!r}")


if __name__ == "__main__":
    log_output_level(CosimLogLevel.WARNING)
    serve(run)
