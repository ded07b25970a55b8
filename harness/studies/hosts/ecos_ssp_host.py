"""ecos with an SSP package; what comes from outside is set in the components, by name."""

from studies.hosts.ecos_host import preload_tbb, stepped
from studies.hosts.job import Job, Rows, serve
from studies.hosts.ssp_package import system_inputs


def run(job: Job) -> Rows:
    """Step the package `job.fmu`; starts and outputs are "component.variable"."""
    preload_tbb()
    from ecospy import EcosSimulation

    entries = system_inputs(job.fmu)
    inputs = [_identifier(entries[name]) for name in job.inputs]
    outputs = [_identifier(name) for name in job.outputs]
    with EcosSimulation(step_size=job.step, ssp_path=job.fmu) as simulation:
        for name, value in job.start.items():
            if isinstance(value, int):
                simulation.set_integer(_identifier(name), value)
            else:
                simulation.set_real(_identifier(name), value)
        if not simulation.init():
            raise RuntimeError("ecos could not initialise the package")
        return stepped(simulation, job, inputs, outputs)


def _identifier(name: str) -> str:
    """Return ecos's name of a "component.variable"."""
    return name.replace(".", "::", 1)


if __name__ == "__main__":
    serve(run)
