"""fmpy's simulation of SSP packages; inputs reach the components one step late there."""

from __future__ import annotations

from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import Parameter, ParameterSet

from slider_resonator.trials.hosts.job import Job, Rows, serve


def run(job: Job) -> Rows:
    """Simulate the package `job.fmu`; starts and outputs are "component.variable"."""
    parameters = [Parameter(name=name, value=value) for name, value in job.start.items()]
    result = simulate_ssp(
        job.fmu,
        stop_time=(job.steps - 0.5) * job.step,  # it adds up steps, with rounding, until there
        step_size=job.step,
        parameter_set=ParameterSet(parameters=parameters),
        input={
            name: lambda time, values=values: values[round(time / job.step)]
            for name, values in job.inputs.items()
        },
    )
    return [[float(row[name]) for name in job.outputs] for row in result]


if __name__ == "__main__":
    serve(run)
