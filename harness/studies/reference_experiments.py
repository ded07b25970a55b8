"""Write the experiments that FMUs carry for other tools (FMI-LS-REF), with results of references.

`PYTHONPATH=harness python -m studies.reference_experiments [FOLDER]` rewrites
fmu_src/assets/reference_experiments. No result comes from an FMU.
"""

import csv
import io
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from slider_resonator.checks.own_experiments import (
    ALLOWED,
    EXPERIMENTS_TYPE,
    MANIFEST,
    NAMESPACE,
    OWN_NAME,
)
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.device.interface import INPUT_STARTS, INPUTS, INTEGERS
from slider_resonator.scenes.device_file import read_device_file
from slider_resonator.scenes.scene import Scene, scene_from

FOLDER = Path(__file__).resolve().parents[2] / "fmu_src" / "assets" / "reference_experiments"
COLUMNS = ("position", "velocity", "resonator_displacement", "resonator_velocity")
"""Outputs with results: those that do not jump, wherever a tool reads them at an input's jump."""
SSP = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"


@dataclass(frozen=True)
class Experiment:
    """A scene, the reference for it, and the allowed deviation as a share of each peak."""

    scene: Mapping[str, Any]
    reference: str
    allowed: float


EXPERIMENTS = {
    "table_1": Experiment(
        {
            "title": "The device of table 1 of the paper, from rest",
            "run": {"stop_time": 0.18, "step_size": 0.001},
        },
        "located_events",
        1e-8,
    ),
    "lugre": Experiment(
        {
            "title": "Table 1 with LuGre friction",
            "device": {"friction_law": 1, "tolerance": 1e-10},
            "inputs": {"phase": 0.4},
            "run": {"stop_time": 0.05, "step_size": 0.0005},
        },
        "bristle_state",
        1e-6,
    ),
    "changing_inputs": Experiment(
        {
            "title": "A slider at 20 kHz under phase, load and frequency that change",
            "device": read_device_file("ultrasonic_slider").values,
            "inputs": {
                "phase": {"steps": [[0.0, 0.4], [0.001, -0.4]]},
                "load": {"steps": [[0.0, 0.0], [0.0005, 0.05]]},
                "frequency_ratio": {"steps": [[0.0, 1.0], [0.0015, 1.01]]},
            },
            "run": {"stop_time": 0.002, "step_size": 2e-5},
        },
        "located_events",
        1e-8,
    ),
}


def files() -> dict[str, bytes]:
    """Return all files of the folder by name."""
    found: dict[str, bytes] = {}
    experiments = ET.Element("Experiments", name="slider-resonator")
    related = [("experiment/validation", EXPERIMENTS_TYPE, "experiments.exp", "Reference runs")]
    for name, one in EXPERIMENTS.items():
        scene = scene_from({"name": name, **one.scene}, name)
        times = {"startTime": 0.0, "stopTime": scene.stop_time, "stepSize": scene.step_size}
        about = {"name": name, "description": scene.title}
        about |= {key: f"{time:g}" for key, time in times.items()}
        entry = ET.SubElement(experiments, "Experiment", about)
        if scene.parameters:
            found[f"{name}.ssv"] = _parameter_set(name, scene.parameters)
            ET.SubElement(entry, "Parameters", source=f"{name}.ssv")
            related.append(
                ("parameter", "application/x-ssp-parameter-set", f"{name}.ssv", scene.title)
            )
        if given := [key for key in INPUTS if {*scene.signals[key].values} != {INPUT_STARTS[key]}]:
            found[f"{name}_in.csv"] = _stimuli(scene, given)
            ET.SubElement(entry, "Stimuli", source=f"{name}_in.csv", type="text/csv")
        found[f"{name}_ref.csv"] = _results(scene, one.reference)
        results = ET.SubElement(entry, "References", source=f"{name}_ref.csv", type="text/csv")
        notes = ET.SubElement(results, "Annotations")
        ET.SubElement(notes, "Annotation", type=ALLOWED).text = f"{one.allowed:g}"
        related.append(("result", "text/csv", f"{name}_ref.csv", f"Results: {scene.title}"))
    found["experiments.exp"] = _text(experiments)
    found[MANIFEST] = _manifest(related)
    return found


def _manifest(related: Iterable[tuple[str, str, str, str]]) -> bytes:
    ET.register_namespace("fmi-ls", NAMESPACE)
    about = {
        "name": OWN_NAME,
        "version": "1.0.0-alpha.1",
        "description": "Layered Standard providing information on related files included in an "
        "FMU.",
    }
    root = ET.Element(
        "fmiReferences", {f"{{{NAMESPACE}}}fmi-ls-{key}": text for key, text in about.items()}
    )
    for role, kind, source, description in related:
        ET.SubElement(root, "Related", type=kind, source=source, role=role, description=description)
    return _text(root)


def _parameter_set(name: str, values: Mapping[str, float]) -> bytes:
    ET.register_namespace("ssv", SSP)
    root = ET.Element(f"{{{SSP}}}ParameterSet", version="1.0", name=name)
    table = ET.SubElement(root, f"{{{SSP}}}Parameters")
    for key, value in values.items():
        entry = ET.SubElement(table, f"{{{SSP}}}Parameter", name=key)
        kind, text = (
            ("Integer", f"{value:.0f}") if key in INTEGERS else ("Real", repr(float(value)))
        )
        ET.SubElement(entry, f"{{{SSP}}}{kind}", value=text)
    return _text(root)


def _stimuli(scene: Scene, names: Sequence[str]) -> bytes:
    """Return inputs at each communication point, each held until the next."""
    times = scene.schedule().times
    rows = [[scene.signals[name].at(time) for name in names] for time in times]
    return _csv(["time", *names], times, rows)


def _results(scene: Scene, reference: str) -> bytes:
    side = ReferenceSide(scene)
    columns = np.array([side.signal(name) for name in COLUMNS])
    return _csv(["time", *COLUMNS], side.times, columns.T)


def _csv(header: Sequence[str], times: Iterable[float], rows: Iterable[Iterable[float]]) -> bytes:
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(
        [f"{time:.9g}", *(f"{value:.12g}" for value in row)]
        for time, row in zip(times, rows, strict=True)
    )
    return file.getvalue().encode()


def _text(root: ET.Element) -> bytes:
    ET.indent(root)
    text: str = ET.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    for file_name, content in files().items():
        (folder / file_name).write_bytes(content)
