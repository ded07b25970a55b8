"""The verdicts as files: JSON, a page to read, and the picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from urllib.parse import quote

from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import HEADING, provenance_markdown
from slider_resonator.output import markdown
from slider_resonator.output.atomic import write_text
from slider_resonator.output.json_output import to_json
from slider_resonator.output.table import Column, Row, Table, texts
from slider_resonator.output.targets import make_folder
from slider_resonator.stress.page import write_matrix_page
from slider_resonator.stress.picture import draw_matrix
from slider_resonator.stress.run import Matrix
from slider_resonator.stress.verdict import PASSED, CellVerdict

AXIS_COLUMNS = (
    *(Column("axis"), Column("cells", numeric=True)),
    *texts("checked by", "nearest to its bound"),
)


def write_matrices(matrices: Sequence[Matrix], out: Path, provenance: Provenance) -> None:
    """Write extremes.json, extremes.md, index.html and a picture for each FMU into a folder.

    Raises HarnessError when that is impossible.
    """
    make_folder(out)
    write_text(out / "extremes.json", to_json(as_plain(matrices), provenance))
    for matrix in matrices:
        draw_matrix(matrix, out / _picture(matrix))
    parts = ["# Stability at the extremes", *(_page(matrix) for matrix in matrices)]
    parts += [f"## {HEADING}", provenance_markdown(provenance)]
    write_text(out / "extremes.md", "\n\n".join(parts) + "\n")
    write_matrix_page(out / "index.html", matrices, provenance)


def as_plain(matrices: Sequence[Matrix]) -> dict[str, object]:
    """Return the results for JSON."""
    return {
        "passed": all(matrix.passed for matrix in matrices),
        "fmus": [
            {
                "fmu": matrix.fmu,
                "passed": matrix.passed,
                "cells": len(matrix.verdicts),
                "not_run": matrix.not_run,
                "counts": matrix.counts,
                "wall_time": matrix.wall_time,
                "worst_step_over_period_cost": matrix.most_expensive
                and matrix.most_expensive.cost_ratio,
                "worst_step_cell": matrix.most_expensive and matrix.most_expensive.name,
                "verdicts": matrix.verdicts,
            }
            for matrix in matrices
        ],
    }


def _page(matrix: Matrix) -> str:
    name = Path(matrix.fmu).name
    others = [one for one in matrix.verdicts if one.verdict != PASSED]
    axes = [_axis_row(axis, verdicts) for axis, verdicts in matrix.by_axis().items()]
    parts = [
        f"## {markdown.escaped(name)}",
        matrix.summary.replace("\n", "\n\n"),
        f"![{markdown.escaped(name)}: the matrix]({quote(_picture(matrix))})",
        "### By axis",
        markdown.rendered(Table(AXIS_COLUMNS, axes)),
    ]
    if others:
        rows = [(one.name, one.verdict, one.reason) for one in others]
        table = Table(texts("cell", "verdict", "reason"), rows)
        parts.extend(["### Not passed", markdown.rendered(table)])
    return "\n\n".join(parts)


def _axis_row(axis: str, verdicts: Sequence[CellVerdict]) -> Row:
    checks = [check for one in verdicts for check in one.checks]
    names = ", ".join(dict.fromkeys(check.name for check in checks))
    nearest = max(checks, key=lambda check: check.found, default=None)
    words = f"{nearest.name}, {nearest.found:.2g} of it" if nearest else ""
    return (axis, str(len(verdicts)), names, words)


def _picture(matrix: Matrix) -> str:
    return f"extremes_{Path(matrix.fmu).stem}.png"
