"""libcosimpy with an SSP package.

libcosim knows no connectors of a system. So it gets the structure without them, and what comes from
outside is set in the components by an override manipulator.
"""

from __future__ import annotations

import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path

from fmpy.ssp.ssd import read_ssd
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver

from slider_resonator.trials.hosts.job import Description, Job, Rows, describe, serve
from slider_resonator.trials.hosts.libcosim_host import NANOSECONDS, set_initial

STRUCTURE = "ComponentsOnly.ssd"


class _Components:
    """The components of a package by name: where each is in the execution, and its variables."""

    def __init__(self, execution: CosimExecution, folder: Path, sources: dict[str, str]) -> None:
        self._slaves = {n: execution.slave_index_from_instance_name(n) for n in sources}
        self._descriptions: dict[str, Description] = {
            name: describe(str(folder / source)) for name, source in sources.items()
        }

    def find(self, names: Sequence[str]) -> list[tuple[int, int]]:
        """Return slave index and value reference of each "component.variable"."""
        pairs = [name.split(".", 1) for name in names]
        return [
            (self._slaves[component], self._descriptions[component].references[variable])
            for component, variable in pairs
        ]


def run(job: Job) -> Rows:
    """Step the package `job.fmu`; starts and outputs are "component.variable"."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with zipfile.ZipFile(job.fmu) as archive:
            archive.extractall(folder)
        system = read_ssd(job.fmu).system
        entries = {
            connection.startConnector: f"{connection.endElement}.{connection.endConnector}"
            for connection in system.connections
            if connection.startElement is None
        }
        execution = CosimExecution.from_ssp_file(
            str(folder / STRUCTURE), step_size=round(job.step * NANOSECONDS)
        )
        sources = {component.name: component.source for component in system.elements}
        components = _Components(execution, folder, sources)
        for (slave, reference), (variable, value) in zip(
            components.find(list(job.start)), job.start.items(), strict=True
        ):
            set_initial(execution, slave, reference, variable, value)
        return _steps(execution, job, components, entries)


def _steps(
    execution: CosimExecution, job: Job, components: _Components, entries: dict[str, str]
) -> Rows:
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    inputs = components.find([entries[name] for name in job.inputs])
    outputs = components.find(job.outputs)
    rows = []
    for index in range(job.steps):
        for (slave, reference), values in zip(inputs, job.inputs.values(), strict=True):
            manipulator.slave_real_values(slave, [reference], [values[index]])
        if not execution.step():
            raise RuntimeError(f"libcosim could not take step {index + 1}")
        rows.append([float(observer.last_real_values(s, [r])[0]) for s, r in outputs])
    return rows


if __name__ == "__main__":
    log_output_level(CosimLogLevel.WARNING)
    serve(run)
