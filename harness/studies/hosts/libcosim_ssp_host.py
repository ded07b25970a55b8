"""libcosimpy with an SSP package.

What comes from outside is set in the components, by an override manipulator.
"""

import tempfile
import zipfile
from collections.abc import Iterable
from pathlib import Path

from fmpy.ssp.ssd import read_ssd
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level

from studies.hosts.job import Description, Job, Rows, describe, serve
from studies.hosts.libcosim_host import NANOSECONDS, Variable, set_initial, stepped
from studies.hosts.ssp_package import system_inputs


class _Components:
    """The components of a package by name: where each is in the execution, and its variables."""

    def __init__(self, execution: CosimExecution, folder: Path, sources: dict[str, str]) -> None:
        self._slaves = {n: execution.slave_index_from_instance_name(n) for n in sources}
        self._descriptions: dict[str, Description] = {
            name: describe(str(folder / source)) for name, source in sources.items()
        }

    def find(self, names: Iterable[str]) -> list[Variable]:
        """Return slave index and value reference of each "component.variable"."""
        pairs = [name.split(".", 1) for name in names]
        return [
            (self._slaves[component], self._descriptions[component].references[variable])
            for component, variable in pairs
        ]


def run(job: Job) -> Rows:
    """Step the package `job.fmu`; starts and outputs are "component.variable"."""
    with tempfile.TemporaryDirectory() as unpacked:
        folder = Path(unpacked)
        with zipfile.ZipFile(job.fmu) as archive:
            archive.extractall(folder)
        execution = CosimExecution.from_ssp_file(job.fmu, step_size=round(job.step * NANOSECONDS))
        elements = read_ssd(job.fmu).system.elements
        sources = {component.name: component.source for component in elements}
        components = _Components(execution, folder, sources)
        for variable, (name, value) in zip(
            components.find(job.start), job.start.items(), strict=True
        ):
            set_initial(execution, variable, name, value)
        entries = system_inputs(job.fmu)
        inputs = components.find(entries[name] for name in job.inputs)
        return stepped(execution, job, inputs, components.find(job.outputs))


if __name__ == "__main__":
    log_output_level(CosimLogLevel.WARNING)
    serve(run)
