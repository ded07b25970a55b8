"""fmuloader: thin bindings of all FMI functions, model exchange included."""

from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

from studies.hosts.job import Job, Rows, describe, serve


def run(job: Job) -> Rows:
    """Step the FMU through its bindings.

    The allocator of fmuloader 0.1.2rc0 cuts pointers to 32 bits, so the FMU is left to its own.
    """
    description = describe(job.fmu)
    with Fmi2Slave(job.fmu, model_identifier=description.identifier) as slave:
        slave.instantiate(
            "slider",
            Fmi2Type.CO_SIMULATION,
            guid=description.guid,
            cannot_use_memory_management_functions=True,
        )
        slave.setup_experiment(start_time=0.0)
        for name, value in job.first().items():
            setter = slave.set_integer if isinstance(value, int) else slave.set_real
            setter(description.refer([name]), [value])
        slave.enter_initialization_mode()
        slave.exit_initialization_mode()
        inputs, outputs = description.refer(list(job.inputs)), description.refer(job.outputs)
        rows = []
        for index in range(job.steps):
            slave.set_real(inputs, [values[index] for values in job.inputs.values()])
            slave.do_step(index * job.step, job.step)
            rows.append(slave.get_real(outputs))
        slave.terminate()
    return rows


if __name__ == "__main__":
    serve(run)
