"""The experiments that an FMU carries (FMI-LS-REF): run them and compare with their results."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path
from time import perf_counter
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.compare import Comparison
from slider_resonator.checks.measuring import Measurement
from slider_resonator.checks.validate import Judged, RunFailure, Validation, judge_points
from slider_resonator.device.units import finite_number
from slider_resonator.errors import HarnessError, SceneError, unknown_name
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.run import Record
from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.scenes.csv_signal import csv_rows, csv_signal
from slider_resonator.scenes.scene import ScenePoint, scene_from
from slider_resonator.scenes.vocabulary import QUANTITIES

OWN_NAME = "org.fmi-standard.fmi-ls-ref"
"""The layered standard, and its folder in `extra`."""
MANIFEST = "fmi-ls-manifest.xml"
NAMESPACE = "http://fmi-standard.org/fmi-ls-manifest"
EXPERIMENTS_TYPE = "application/x-ma-hs-experiments"
ALLOWED = "slider-resonator.deviation-of-peak"
"""Type of the annotation with the allowed deviation, as a share of the peak of each result."""


@dataclass(frozen=True, eq=False, kw_only=True)
class OwnExperiment(ScenePoint):
    """An experiment of an FMU: `results` by output at `times` (s), shape (n,).

    They may deviate by `allowed`, a share of the peak of each.
    """

    times: Array
    results: Mapping[str, Array]
    allowed: float


def own_experiments(fmu: Path) -> list[OwnExperiment]:
    """Return the experiments that an FMU carries.

    Raises FmuError for a file that is no usable FMU, SceneError for one without experiments and for
    experiments that cannot be read.
    """
    with open_fmu(fmu) as opened:
        folder = opened.folder / "extra" / OWN_NAME
        manifest = folder / MANIFEST
        if not manifest.is_file():
            missing = f"extra/{OWN_NAME}/{MANIFEST} is missing"
            raise SceneError(f"{fmu}: carries no experiments: {missing}")
        try:
            found = [
                _experiment(entry, file, opened.folder)
                for related in _root(manifest).iter("Related")
                if related.get("type") == EXPERIMENTS_TYPE
                for file in [_source(related, folder, opened.folder)]
                for entry in _root(file).iter("Experiment")
            ]
        except ValueError as error:  # of a number or a table
            raise SceneError(str(error).replace(f"{opened.folder}/", "")) from error
    if not found:
        raise SceneError(f"{fmu}: carries no experiments: {MANIFEST} names none")
    return found


def validate_own(
    fmus: Iterable[Path], progress: Progress = no_progress, *, time_limit: float = TIME_LIMIT
) -> tuple[Validation, ...]:
    """Run the experiments that each FMU carries, and compare with the results beside them.

    An FMU that has none, or cannot run one within `time_limit` (s), is a run failure.
    """
    found = []
    for fmu in fmus:
        began = perf_counter()
        try:
            experiments = own_experiments(fmu)
        except HarnessError as error:
            failure = RunFailure.of(fmu, None, error)
            found.append(Validation(str(fmu), (), perf_counter() - began, (failure,)))
            continue
        task = attrgetter("record")
        found.append(judge_points(fmu, experiments, task, _judged, progress, time_limit))
    return tuple(found)


def _judged(experiment: OwnExperiment, record: Record) -> Iterator[Judged]:
    """Yield each result with what the FMU gives; SceneError for one between two steps."""
    scene, times = experiment.scene, experiment.times
    rows = np.abs(record.times[:, None] - times).argmin(axis=0)
    late = np.abs(record.times[rows] - times) > 1e-6 * (scene.step_size or 0.0)
    if late.any():
        raise SceneError(f"result at time = {times[late][0]:.9g}: must be a communication point")
    for name, expected in experiment.results.items():
        why = "the FMU carries this result of its experiment"
        comparison = Comparison(name, "own result", why, relative=experiment.allowed)
        yield comparison, Measurement(record[name][rows], times=times), expected


def _experiment(entry: ET.Element, file: Path, root: Path) -> OwnExperiment:
    """Return an experiment of a file of the FMU that is unpacked in `root`.

    Drafts of the format have times as attributes of it or of <TransientSimulation>.
    """
    name = re.sub(r"[^\w-]", "_", entry.get("name", "")) or "experiment"
    where = f"{file.name}: experiment {name}"
    transient = getattr(entry.find("TransientSimulation"), "attrib", {})
    run = {"startTime": "0", **entry.attrib, **transient}
    keys = {"stop_time": "stopTime", "step_size": "stepSize", "start_time": "startTime"}
    sources = {
        kind: _source(named, file.parent, root)
        for kind in ("Parameters", "Stimuli", "References")
        if (named := entry.find(kind)) is not None
    }
    if "References" not in sources:
        raise SceneError(f"{where}: <References> is missing; must name a CSV file")
    inputs, device = dict[str, Any](), dict[str, float]()
    if stimuli := sources.get("Stimuli"):  # values at communication points, held until the next
        held = {"csv": str(stimuli), "between": "hold"}
        inputs = {column: {**held, "column": column} for column in _columns(stimuli)}
    if parameters := sources.get("Parameters"):  # whatever the version of its namespace
        for one in _root(parameters).iterfind(".//{*}Parameter"):
            text = next((value.get("value") for value in one), None)
            parameter = one.get("name", "")
            device[parameter] = finite_number(f"{parameters.name}: {parameter}", text)
    scene = scene_from(
        {
            "name": name,
            "title": entry.get("description") or name,
            "device": device,
            "inputs": inputs,
            "run": {
                key: finite_number(f"{where}: {time}", run.get(time)) for key, time in keys.items()
            },
        },
        where,
    )
    annotation = f"References/Annotations/Annotation[@type='{ALLOWED}']"
    allowed = finite_number(f"{where}: {ALLOWED}", entry.findtext(annotation, "1e-4"))
    if not 0.0 < allowed < 1.0:
        raise SceneError(f"{where}: {ALLOWED} = {allowed:g}: must be a share between 0 and 1")
    times, results = _results(sources["References"])
    return OwnExperiment(scene, times=times, results=results, allowed=allowed)


def _columns(table: Path) -> list[str]:
    """Return the names of the columns of a table, at least one, without that of the time."""
    names = csv_rows(table)[0][1:]
    if not names:
        raise SceneError(f"{table.name}: no column but time; must have one for each variable")
    return names


def _results(table: Path) -> tuple[Array, dict[str, Array]]:
    """Return the times (s) of a table of results, and its columns by name."""
    signals = [name for name, one in QUANTITIES.items() if one.kind == "signal"]
    times, results = np.zeros(0), dict[str, Array]()
    for name in _columns(table):
        if name not in signals:
            raise SceneError(f"{table.name}: {unknown_name('column', name, signals)}")
        column = csv_signal(table, name, "hold", QUANTITIES[name].unit)
        times, results[name] = np.array(column.times), np.array(column.values)
    return times, results


def _source(element: ET.Element, folder: Path, root: Path) -> Path:
    """Return the file that an element names, from the folder of its own; it must be in the FMU."""
    source = element.get("source", "")
    file = (folder / source).resolve()
    if file not in root.resolve().rglob("*") or not file.is_file():
        raise SceneError(f"{element.tag}: source = {source!r}: must be a file in the FMU")
    return file


def _root(file: Path) -> ET.Element:
    try:
        return ET.fromstring(file.read_bytes())
    except (ET.ParseError, LookupError, ValueError) as error:  # the latter two for encodings
        raise SceneError(f"{file.name}: {error}; must be XML") from error
