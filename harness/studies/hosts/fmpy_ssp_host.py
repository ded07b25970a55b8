"""fmpy's simulation of SSP packages; inputs reach the components one step late there.

It takes inputs that vary from connectors of the system only, and reads the first structure only.
"""

import tempfile
from pathlib import Path

from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import Parameter, ParameterSet

from studies.hosts.job import Job, Rows, serve
from studies.hosts.ssp_package import write_with_connectors


def run(job: Job) -> Rows:
    """Simulate the package `job.fmu`; starts and outputs are "component.variable"."""
    parameters = [Parameter(name=name, value=value) for name, value in job.start.items()]
    with tempfile.TemporaryDirectory() as folder:
        package = Path(folder) / "package.ssp"
        write_with_connectors(job.fmu, package)
        result = simulate_ssp(
            str(package),
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
