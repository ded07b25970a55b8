"""pathsim with its block for co-simulation FMUs."""

from collections.abc import Callable, Sequence

from pathsim import Connection, Simulation
from pathsim.blocks import Scope, Source
from pathsim_fmi import CoSimulationFMU

from studies.hosts.job import Job, Rows, serve


def run(job: Job) -> Rows:
    """Simulate sources for the inputs, the FMU and a scope for its outputs.

    The block steps the FMU at t = 0 already, so that the scope shows each row one step early.
    """
    block = CoSimulationFMU(job.fmu, start_values=job.first(), dt=job.step)
    ports = list(block.fmu_wrapper.input_refs), list(block.fmu_wrapper.output_refs)
    # All inputs are wired: what the job leaves out is 0, the start of the deviations of the drive.
    sources = [Source(held(job.inputs.get(name, [0.0]), job.step)) for name in ports[0]]
    scope = Scope(labels=ports[1])
    wires = [Connection(source, block[index]) for index, source in enumerate(sources)]
    wires += [Connection(block[index], scope[index]) for index in range(len(ports[1]))]
    simulation = Simulation([block, *sources, scope], wires, dt=job.step, log=False)
    simulation.run((job.steps - 1) * job.step)
    _, signals = scope.read()
    columns = [signals[ports[1].index(name)] for name in job.outputs]
    return [[float(value) for value in row] for row in zip(*columns, strict=True)][: job.steps]


def held(values: Sequence[float], step: float) -> Callable[[float], float]:
    """Return `values` as a function of time (s), each held over its step."""
    return lambda t: values[min(round(t / step), len(values) - 1)]


if __name__ == "__main__":
    serve(run)
