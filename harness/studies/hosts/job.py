"""Jobs and answers of a host, as files that any Python environment reads."""

import json
import sys
import zipfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

Rows = list[list[float]]
"""Outputs after each step, shape (steps, outputs)."""


@dataclass(frozen=True)
class Job:
    """A run of `fmu` from time 0 in equal steps of `step` (s).

    `start` gives parameters (Integer parameters as int), `inputs` one value for each step, held
    over it; the first of them are the start values of the inputs. `partner` is a second FMU, for
    hosts that couple two.
    """

    fmu: str
    start: Mapping[str, float]
    inputs: Mapping[str, Sequence[float]]
    step: float
    outputs: Sequence[str]
    partner: str | None = None

    @property
    def steps(self) -> int:
        """Number of steps."""
        return len(next(iter(self.inputs.values())))

    def first(self) -> dict[str, float]:
        """Return all values that are set before initialisation."""
        return {**self.start, **{name: values[0] for name, values in self.inputs.items()}}


@dataclass(frozen=True)
class HostAnswer:
    """The answer to a job: rows, or an error message."""

    rows: Rows
    error: str | None = None


@dataclass(frozen=True)
class Description:
    """What a host needs of a model description: value references by name, and three texts.

    `guid` is the instantiation token of FMI 3.0, `version` that of FMI.
    """

    guid: str
    identifier: str
    references: Mapping[str, int]
    version: str

    def refer(self, names: Sequence[str]) -> list[int]:
        """Return the value references of `names`."""
        return [self.references[name] for name in names]


def describe(fmu: str) -> Description:
    """Read the description of a co-simulation FMU with nothing but the standard library."""
    with zipfile.ZipFile(fmu) as archive, archive.open("modelDescription.xml") as file:
        root = ET.parse(file).getroot()
    references = {
        variable.attrib["name"]: int(variable.attrib["valueReference"])
        for variable in root.iterfind("ModelVariables/*")
    }
    (simulation,) = root.iter("CoSimulation")
    version = root.attrib["fmiVersion"]
    guid = root.attrib["guid" if version == "2.0" else "instantiationToken"]
    return Description(guid, simulation.attrib["modelIdentifier"], references, version)


def write_jobs(path: Path, jobs: Sequence[Job]) -> None:
    """Write jobs for `serve`."""
    path.write_text(json.dumps([asdict(job) for job in jobs]), encoding="utf-8")


def read_answers(path: Path) -> list[HostAnswer]:
    """Read the answers; there are fewer than jobs when the host died."""
    if not path.is_file():
        return []
    lines = path.read_text(encoding="utf-8").splitlines()
    return [HostAnswer(**json.loads(line)) for line in lines]


def serve(run: Callable[[Job], Rows]) -> None:
    """Answer the jobs in the file of the first argument, into the file of the second.

    Each answer is written at once, so that a host that crashes leaves those before it.
    """
    jobs, answers = sys.argv[1:]
    with open(answers, "w", encoding="utf-8") as file:
        for entry in json.loads(Path(jobs).read_text(encoding="utf-8")):
            try:
                answer = HostAnswer(run(Job(**entry)))
            except Exception as error:  # each host raises its own
                answer = HostAnswer([], f"{type(error).__name__}: {error}")
            file.write(json.dumps(asdict(answer)) + "\n")
            file.flush()
