"""libcosimpy: the C++ co-simulation library of the Open Simulation Platform."""

from collections.abc import Sequence

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from studies.hosts.job import Job, Rows, describe, serve

NANOSECONDS = 1e9

Variable = tuple[int, int]
"""Index of a slave and value reference in it."""


def run(job: Job) -> Rows:
    """Step an execution with one slave that is the FMU."""
    description = describe(job.fmu)
    execution = CosimExecution.from_step_size(round(job.step * NANOSECONDS))
    slave = execution.add_local_slave(CosimLocalSlave(job.fmu, "slider"))
    if slave < 0:
        raise RuntimeError("libcosim could not load the FMU")
    references = description.references
    for name, value in job.first().items():
        set_initial(execution, (slave, references[name]), name, value)
    inputs, outputs = (
        [(slave, references[name]) for name in names] for names in (job.inputs, job.outputs)
    )
    return stepped(execution, job, inputs, outputs)


def stepped(
    execution: CosimExecution, job: Job, inputs: Sequence[Variable], outputs: Sequence[Variable]
) -> Rows:
    """Take the steps of a job, with inputs from an override manipulator; RuntimeError if refused.

    `inputs` and `outputs` are in the order of the job's.
    """
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    rows = []
    for index in range(job.steps):
        for (slave, reference), values in zip(inputs, job.inputs.values(), strict=True):
            manipulator.slave_real_values(slave, [reference], [values[index]])
        if not execution.step():
            raise RuntimeError(f"libcosim could not take step {index + 1}")
        rows.append([float(observer.last_real_values(s, [r])[0]) for s, r in outputs])
    return rows


def set_initial(execution: CosimExecution, variable: Variable, name: str, value: float) -> None:
    """Set a value before initialisation, an Integer where it is an int; RuntimeError if refused."""
    if isinstance(value, int):
        taken = execution.integer_initial_value(*variable, value)
    else:
        taken = execution.real_initial_value(*variable, value)
    if not taken:
        raise RuntimeError(f"libcosim did not take {name} = {value!r}")


if __name__ == "__main__":
    log_output_level(CosimLogLevel.WARNING)
    serve(run)
