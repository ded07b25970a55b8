"""The verdicts as files: JSON, a page to read, and the picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from slider_resonator.output.atomic import replacing
from slider_resonator.output.json_output import to_json
from slider_resonator.output.targets import make_folder
from slider_resonator.trials.extremes.picture import draw_matrix
from slider_resonator.trials.extremes.run import Matrix
from slider_resonator.trials.extremes.verdict import PASSED, CellVerdict


def write_matrices(matrices: Sequence[Matrix], out: Path) -> None:
    """Write extremes.json, extremes.md and a picture for each FMU into a folder.

    Raises HarnessError when that is impossible.
    """
    make_folder(out)
    _write(out / "extremes.json", lambda path: _text(path, to_json(as_plain(matrices))))
    for matrix in matrices:
        _write(out / _picture(matrix), partial(draw_matrix, matrix))
    page = "\n\n".join(["# Stability at the extremes", *(_page(matrix) for matrix in matrices)])
    _write(out / "extremes.md", lambda path: _text(path, page + "\n"))


def as_plain(matrices: Sequence[Matrix]) -> dict[str, object]:
    """Return the results for JSON."""
    return {
        "passed": all(matrix.passed for matrix in matrices),
        "fmus": [
            {
                "fmu": matrix.fmu,
                "passed": matrix.passed,
                "cells": len(matrix.verdicts),
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
    table = ["| cell | verdict | reason |", "|---|---|---|"]
    table.extend(f"| {one.name} | {one.verdict} | {_cell(one.reason)} |" for one in others)
    checks = ["| axis | cells | checked by | nearest to its bound |", "|---|---|---|---|"]
    for axis in dict.fromkeys(one.axis for one in matrix.verdicts):
        checks.append(_axis_row(axis, [one for one in matrix.verdicts if one.axis == axis]))
    parts = [
        f"## {name}",
        matrix.summary.replace("\n", "\n\n"),
        f"![{name}: the matrix]({_picture(matrix)})",
        "### By axis",
        "\n".join(checks),
    ]
    if others:
        parts.extend(["### Not passed", "\n".join(table)])
    return "\n\n".join(parts)


def _axis_row(axis: str, verdicts: Sequence[CellVerdict]) -> str:
    checks = [check for one in verdicts for check in one.checks]
    names = ", ".join(dict.fromkeys(check.name for check in checks))
    nearest = max(checks, key=lambda check: check.found, default=None)
    words = f"{nearest.name}, {nearest.found:.2g} of it" if nearest else ""
    return f"| {axis} | {len(verdicts)} | {names} | {words} |"


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def _picture(matrix: Matrix) -> str:
    return f"extremes_{Path(matrix.fmu).stem}.png"


def _write(path: Path, write: Callable[[Path], None]) -> None:
    with replacing(path) as temporary:
        write(temporary)


def _text(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")
