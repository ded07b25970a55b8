"""ecos with an SSP package; what comes from outside is set in the components, by name."""

from studies.hosts.ecos_host import preload_tbb
from studies.hosts.job import Job, Rows, serve
from studies.hosts.ssp_package import system_inputs


def run(job: Job) -> Rows:
    """Step the package `job.fmu`; starts and outputs are "component.variable"."""
    preload_tbb()
    from ecospy import EcosSimulation

    entries = system_inputs(job.fmu)
    inputs = [(_identifier(entries[name]), values) for name, values in job.inputs.items()]
    outputs = [_identifier(name) for name in job.outputs]
    with EcosSimulation(step_size=job.step, ssp_path=job.fmu) as simulation:
        for name, value in job.start.items():
            if isinstance(value, int):
                simulation.set_integer(_identifier(name), value)
            else:
                simulation.set_real(_identifier(name), value)
        if not simulation.init():
            raise RuntimeError("ecos could not initialise the package")
        rows = []
        for index in range(job.steps):
            for name, held in inputs:
                simulation.set_real(name, held[index])
            simulation.step()
            rows.append([simulation.get_real(name) for name in outputs])
        simulation.terminate()
        return rows


def _identifier(name: str) -> str:
    """Return ecos's name of a "component.variable"."""
    return name.replace(".", "::", 1)


if __name__ == "__main__":
    serve(run)
