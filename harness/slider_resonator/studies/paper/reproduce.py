"""The whole paper: every figure, table and claim, of which only what is new or changed is run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from types import FunctionType
from typing import Any, cast

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.names import unknown_name
from slider_resonator.output.atomic import replacing
from slider_resonator.output.plot_style import save, style
from slider_resonator.output.targets import make_folder
from slider_resonator.studies.paper import (
    average_error,
    claims_coulomb,
    claims_device,
    claims_lugre,
    claims_resonator,
    figure_2,
    figure_3,
    figure_4,
    figure_5,
    figure_7,
    figure_8,
    lugre_blocking,
    lugre_device,
    stiffness_validity,
    velocity_map,
)
from slider_resonator.studies.paper.claim import ClaimGroup
from slider_resonator.studies.paper.figure import PaperFigure
from slider_resonator.studies.paper.listing import write_claims, write_figures, write_tables
from slider_resonator.studies.paper.store import key_of, store, stored
from slider_resonator.studies.paper.table import PaperTable

FIGURES: Mapping[str, PaperFigure] = {
    module.FIGURE.name: module.FIGURE
    for module in (
        figure_2,
        figure_3,
        figure_4,
        figure_5,
        figure_7,
        figure_8,
        stiffness_validity,
        velocity_map,
        average_error,
    )
}
TABLES: Mapping[str, PaperTable] = {
    module.TABLE.name: module.TABLE for module in (lugre_blocking, lugre_device)
}
GROUPS: tuple[ClaimGroup, ...] = (
    claims_device.GROUP,
    claims_coulomb.GROUP,
    claims_lugre.GROUP,
    claims_resonator.GROUP,
)
CLAIMS = "claims"
NAMES = (*FIGURES, *TABLES, CLAIMS)
SUFFIXES = (".png", ".svg")
RESULTS = "results"
"""Folder of measured data within the report."""

Progress = Callable[[str, float], None]
Job = PaperFigure | PaperTable | ClaimGroup


@dataclass(frozen=True)
class Judged:
    """A table's largest deviations, those that are allowed, and whether all are within."""

    name: str
    largest: Mapping[str, float]
    allowed: Mapping[str, float]
    confirmed: bool


@dataclass(frozen=True)
class Outcome:
    """What was done: names run and kept, tables and claims as judged, and seconds taken."""

    out: str
    fmu: str
    guid: str
    run: Sequence[str]
    kept: Sequence[str]
    tables: Sequence[Judged]
    claims: Sequence[Mapping[str, Any]]
    wall_time: float

    @property
    def confirmed(self) -> bool:
        """Whether every table and claim was found as it is known to be."""
        tables = all(table.confirmed for table in self.tables)
        return tables and all(claim["confirmed"] for claim in self.claims)


def reproduce(fmu_path: Path, out: Path, only: Sequence[str], progress: Progress) -> Outcome:
    """Write the report to the folder ``out``; ``only`` names some of `NAMES`, () is all.

    A figure, table or group of claims whose key is that of the results beside it is not run again.
    Raises HarnessError for an unknown name, a file or folder that cannot be written, and as
    `open_fmu` does.
    """
    for name in only:
        if name not in NAMES:
            raise HarnessError(unknown_name("figure", name, NAMES))
    make_folder(out / RESULTS)
    began = perf_counter()
    chosen = only or NAMES
    done: list[str] = []
    kept: list[str] = []
    tables: list[Judged] = []
    claims: list[tuple[str, Any]] = []
    with open_fmu(fmu_path) as fmu, instantiate(fmu) as instance:
        guid = str(fmu.description.guid)
        for name in FIGURES:
            if name in chosen:
                fresh = _figure(instance, FIGURES[name], out, guid, progress)
                (done if fresh else kept).append(name)
        for name, table in TABLES.items():
            if name in chosen:
                data, fresh = _measured(instance, table, out, guid, progress)
                largest, confirmed = table.largest(data), table.confirmed(data)
                tables.append(Judged(name, largest, table.bounds, confirmed))
                (done if fresh else kept).append(name)
        for group in GROUPS:
            if CLAIMS in chosen:
                found, fresh = _measured(instance, group, out, guid, progress)
                claims.append((group.title, found))
                (done if fresh else kept).append(group.name)
    present = [
        figure
        for name, figure in FIGURES.items()
        if _drawn(out, name) and stored(_results(out, name), _key(figure, guid)) is not None
    ]
    write_figures(out, present, fmu_path.name, guid)
    stored_tables = [(t, stored(_results(out, t.name), _key(t, guid))) for t in TABLES.values()]
    write_tables(out, [(t, d) for t, d in stored_tables if d is not None], fmu_path.name, guid)
    if claims:
        write_claims(out, claims, fmu_path.name, guid)
    flat = [claim for _, group in claims for claim in group]
    took = perf_counter() - began
    return Outcome(str(out), str(fmu_path), guid, done, kept, tables, flat, took)


def _figure(
    instance: Instance, figure: PaperFigure, out: Path, guid: str, progress: Progress
) -> bool:
    """Measure and draw a figure where needed; returns whether anything was."""
    data = stored(_results(out, figure.name), _key(figure, guid))
    if data is None:
        # A picture of older results must not outlive them when the drawing does not come to pass.
        for suffix in SUFFIXES:
            (out / f"{figure.name}{suffix}").unlink(missing_ok=True)
    data, fresh = _measured(instance, figure, out, guid, progress)
    if not fresh and _drawn(out, figure.name):
        return False
    progress(f"{figure.name}: drawing", 1.0)
    with style():
        drawing = figure.draw(data)
        for suffix in SUFFIXES:
            with replacing(out / f"{figure.name}{suffix}") as temporary:
                save(drawing, temporary)
    return True


def _measured(
    instance: Instance, job: Job, out: Path, guid: str, progress: Progress
) -> tuple[Any, bool]:
    """Return the data of a figure, table or group, and whether they are new."""
    path, key = _results(out, job.name), _key(job, guid)
    data = stored(path, key)
    if data is not None:
        return data, False
    progress(job.name, 0.0)
    found = job.measure(instance, lambda share: progress(job.name, share))
    plain = found if isinstance(found, dict) else [claim.plain() for claim in found]
    return store(path, key, plain), True


def _results(out: Path, name: str) -> Path:
    return out / RESULTS / f"{name}.json"


def _key(job: Job, guid: str) -> str:
    return key_of(job.parameters, guid, cast(FunctionType, job.measure))


def _drawn(out: Path, name: str) -> bool:
    return all((out / f"{name}{suffix}").is_file() for suffix in SUFFIXES)
