"""CoFmuPy: couples FMUs by a configuration; runs in a separate environment."""

from cofmupy import Coordinator

from studies.hosts.job import Job, Rows, serve

SLIDER = "slider"


def run(job: Job) -> Rows:
    """Step a coordinator with one FMU whose inputs are literal streams.

    CoFmuPy 1.0.0 writes all start values as Reals, which no FMI 2.0 FMU may accept for Integers,
    and leaves no gap before initialisation: so it starts once with the values of the description,
    and the FMU is then reset, given its start values and initialised again.
    """
    streams = [
        {
            "source": {
                "type": "literal",
                "values": {repr(index * job.step): value for index, value in enumerate(values)},
                "interpolation": "nearest",
            },
            "target": [{"type": "fmu", "id": SLIDER, "variable": name, "unit": ""}],
        }
        for name, values in job.inputs.items()
    ]
    fmu = {"id": SLIDER, "name": SLIDER, "path": job.fmu, "initialization": {}}
    coordinator = Coordinator()
    coordinator.start({"fmus": [fmu], "connections": streams})
    handler = coordinator.master.fmu_handlers[SLIDER]
    handler.fmu.reset()
    for name, value in job.first().items():
        setter = handler.fmu.setInteger if isinstance(value, int) else handler.fmu.setReal
        setter([handler.var_name2attr[name].valueReference], [value])
    handler.reset()  # sets up and initialises, in spite of its name
    for _ in range(job.steps):
        coordinator.do_step(job.step)
    results = coordinator.get_results()
    columns = [results[SLIDER, name] for name in job.outputs]
    return [[float(value) for value in row] for row in zip(*columns, strict=True)]


if __name__ == "__main__":
    serve(run)
