"""libcosimpy with an SSP package.

What comes from outside is set in the components, by an override manipulator.
"""

import tempfile
import zipfile
from pathlib import Path

from fmpy.ssp.ssd import read_ssd
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level

from studies.hosts.job import Job, Rows, describe, serve
from studies.hosts.libcosim_host import NANOSECONDS, Variable, set_initial, stepped
from studies.hosts.ssp_package import system_inputs


def run(job: Job) -> Rows:
    """Step the package `job.fmu`; starts and outputs are "component.variable"."""
    with tempfile.TemporaryDirectory() as unpacked:
        folder = Path(unpacked)
        with zipfile.ZipFile(job.fmu) as archive:
            archive.extractall(folder)
        execution = CosimExecution.from_ssp_file(job.fmu, step_size=round(job.step * NANOSECONDS))
        sources = {part.name: part.source for part in read_ssd(job.fmu).system.elements}
        slaves = {name: execution.slave_index_from_instance_name(name) for name in sources}
        described = {name: describe(str(folder / source)) for name, source in sources.items()}

        def found(name: str) -> Variable:
            component, variable = name.split(".", 1)
            return slaves[component], described[component].references[variable]

        for name, value in job.start.items():
            set_initial(execution, found(name), name, value)
        entries = system_inputs(job.fmu)
        inputs = [found(entries[name]) for name in job.inputs]
        return stepped(execution, job, inputs, list(map(found, job.outputs)))


if __name__ == "__main__":
    log_output_level(CosimLogLevel.WARNING)
    serve(run)
