"""The whole paper: every figure, table and claim."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any

from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.console import noting_on_interrupt
from slider_resonator.output.files import make_folder, write_text
from slider_resonator.output.json_output import to_json
from slider_resonator.output.plot_style import save, style
from slider_resonator.output.progress import Progress, counted
from studies.paper import (
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
    lugre_tables,
    stiffness_validity,
    velocity_map,
)
from studies.paper.claim import Claim, ClaimGroup
from studies.paper.figure import Data, PaperFigure
from studies.paper.listing import write_claims, write_figures, write_index, write_tables
from studies.paper.table import PaperTable

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
    table.name: table for table in (lugre_tables.BLOCKING, lugre_tables.DEVICE)
}
GROUPS: Mapping[str, ClaimGroup] = {
    module.GROUP.name: module.GROUP
    for module in (claims_device, claims_coulomb, claims_lugre, claims_resonator)
}
CLAIMS = "claims"
NAMES = (*FIGURES, *TABLES, CLAIMS)
SUFFIXES = (".png", ".svg")
RESULTS = "results"
"""Folder of measured data within the report."""
TIME_LIMIT = 900.0
"""Default time limit of a figure, a table or a group of claims, s."""


@dataclass(frozen=True)
class Judged:
    """A table's largest deviations, those that are allowed, and whether all are within."""

    name: str
    largest: Mapping[str, float]
    allowed: Mapping[str, float]
    confirmed: bool


@dataclass(frozen=True)
class Outcome:
    """The names that were run, the judged tables and claims, and the wall time in s."""

    out: str
    fmu: str
    guid: str
    run: Sequence[str]
    tables: Sequence[Judged]
    claims: Sequence[Claim]
    wall_time: float

    @property
    def confirmed(self) -> bool:
        """Whether every table and claim has its known verdict."""
        tables = all(table.confirmed for table in self.tables)
        return tables and all(claim.confirmed for claim in self.claims)


def reproduce(
    fmu_path: Path,
    out: Path,
    only: Sequence[str],
    progress: Progress,
    time_limit: float = TIME_LIMIT,
) -> Outcome:
    """Write the report to the folder ``out``; ``only`` names some of `NAMES`, () is all.

    The FMU runs in a process of its own, which may take ``time_limit`` (s) for each of them. Raises
    HarnessError for an unknown name, a file or folder that cannot be written, and as `IsolatedFmu`
    does.
    """
    for name in only:
        if name not in NAMES:
            raise HarnessError(unknown_name("figure", name, NAMES))
    make_folder(out / RESULTS)
    provenance = provenance_of(fmu_path)
    began = perf_counter()
    chosen = only or NAMES
    figures = [figure for name, figure in FIGURES.items() if name in chosen]
    tables = [table for name, table in TABLES.items() if name in chosen]
    groups = [*GROUPS.values()] if CLAIMS in chosen else []
    jobs: list[PaperFigure | PaperTable | ClaimGroup] = [*figures, *tables, *groups]
    found: dict[str, Any] = {}
    with noting_on_interrupt(lambda: _kept(found, out)), IsolatedFmu(fmu_path, time_limit) as fmu:
        guid = provenance.fmus[0].guid or ""
        for index, job in enumerate(jobs):
            progress(counted(job.name, index, len(jobs)), index / len(jobs))
            found[job.name] = fmu.run(partial(_measure, job.name))
            results = to_json({"guid": guid, "data": found[job.name]}, provenance)
            write_text(out / RESULTS / f"{job.name}.json", results + "\n")
            if isinstance(job, PaperFigure):
                _draw(job, found[job.name], out)
    measured = [(table, found[table.name]) for table in tables]
    if figures:
        write_figures(out, figures, provenance)
    if tables:
        write_tables(out, measured, provenance)
    claims = [(group.title, found[group.name]) for group in groups]
    if claims:
        write_claims(out, claims, provenance)
    write_index(out, figures, measured, claims, provenance)
    return Outcome(
        out=str(out),
        fmu=str(fmu_path),
        guid=guid,
        run=list(found),
        tables=[
            Judged(table.name, table.largest(data), table.bounds, table.confirmed(data))
            for table, data in measured
        ],
        claims=[claim for _, group in claims for claim in group],
        wall_time=perf_counter() - began,
    )


def _kept(found: Mapping[str, Any], out: Path) -> str:
    kept = f"kept in {out}: {', '.join(found)}" if found else "nothing is finished"
    return f"{kept}; --only makes the others"


def _measure(name: str, instance: Instance) -> Any:
    """Measure a figure, a table or a group of claims, in the process of the FMU."""
    jobs: Mapping[str, PaperFigure | PaperTable | ClaimGroup] = {**FIGURES, **TABLES, **GROUPS}
    return jobs[name].measure(instance)


def _draw(figure: PaperFigure, data: Data, out: Path) -> None:
    with style():
        drawing = figure.draw(data)
        for suffix in SUFFIXES:
            save(drawing, out / f"{figure.name}{suffix}")
