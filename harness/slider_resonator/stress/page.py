"""The matrices as a page of HTML: a grid for each axis, and every cell over its bound."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path

from matplotlib.colors import to_hex

from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.hover_plot import (
    Axis,
    HoverPlot,
    Series,
    hover_scripts,
    hover_style,
    look,
    plot_html,
)
from slider_resonator.output.html_page import escaped, rendered, section, write_page
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts, verdict_so_far
from slider_resonator.stress.case import MODELS
from slider_resonator.stress.picture import (
    FAILED_COLOUR,
    FAR,
    NEAR,
    REFUSED_COLOUR,
    SHADES,
    cell_colour,
    margin,
)
from slider_resonator.stress.run import Matrix
from slider_resonator.stress.verdict import (
    FAILED,
    PASSED,
    REFUSED,
    BoundCheck,
    CellVerdict,
)

SIGNS = {PASSED: "", REFUSED: "r", FAILED: "F"}
"""What a cell of the grid shows besides its colour."""
STYLE = """
.matrix { width: auto } .matrix th { font-weight: 400; vertical-align: bottom }
.matrix thead th:not(:first-child) { text-align: center; width: 4.5rem; font-size: 12px }
.matrix tbody th { white-space: nowrap }
.matrix td { text-align: center; padding: .1rem .3rem; min-width: 3rem !important; height: 1.1rem;
  border: 1px solid #fff; cursor: help }
"""


def write_matrix_page(path: Path, matrices: Sequence[Matrix], provenance: Provenance) -> None:
    """Write the page; HarnessError when that is impossible."""
    parts = [_overview(matrices), _scale()]
    parts += [part for matrix in matrices for part in _matrix(matrix)]
    parts.append(provenance_html(provenance))
    style = hover_style() + STYLE
    write_page(path, "Stability at the extremes", parts, hover_scripts(), style)


def repeating(matrix: Matrix, cell: CellVerdict) -> str:
    """Return the command that runs one cell again."""
    words = ("slider-resonator", "extremes", matrix.fmu, "--cell", cell.name, "--out", "one_cell")
    return shlex.join(words)


def _overview(matrices: Sequence[Matrix]) -> str:
    rows: list[Row] = [
        (
            Path(one.fmu).name,
            verdict_so_far(one.failed, one.not_run),
            *(str(one.counts[name]) for name in (PASSED, REFUSED, FAILED)),
            str(one.not_run),
            f"{one.wall_time:.0f}",
        )
        for one in matrices
    ]
    columns = (
        *texts("FMU", "verdict"),
        *numbers(PASSED, REFUSED, FAILED, "not run", "wall time [s]"),
    )
    return rendered(Table(columns, rows))


def _scale() -> str:
    shades = ", ".join(to_hex(SHADES(i / 8)) for i in range(9))
    return (
        "<p>Columns are friction law and fidelity. A cell in the grid, or a point in the plot, "
        "says its checks. A cell is shaded by its largest deviation over the allowed one; "
        f'<b style="background: {REFUSED_COLOUR}">&nbsp;r&nbsp;</b> is refused by name, '
        f'<b style="background: {FAILED_COLOUR}">&nbsp;F&nbsp;</b> failed.</p>'
        f'<p class="scale">{10.0**FAR:g} '
        f'<i style="background: linear-gradient(to right, {shades})"></i> {10.0**NEAR:g}</p>'
    )


def _matrix(matrix: Matrix) -> list[str]:
    parts = [f"<h2>{escaped(Path(matrix.fmu).name)}</h2>"]
    parts += [f"<p>{escaped(line)}</p>" for line in matrix.summary.splitlines()]
    for name in (FAILED, REFUSED):
        chosen = [one for one in matrix.verdicts if one.verdict == name]
        if chosen:
            heading = f"{name[0].upper()}{name[1:]}"
            cells = number_of(len(chosen), "cell")
            found = rendered(_others(matrix, chosen))
            anchor = f"{name}-{Path(matrix.fmu).name}".replace(" ", "-")
            parts.append(section(anchor, heading, cells, found, unfolded=name == FAILED))
    parts.append(plot_html(_plot(matrix)))
    parts += [_grid(axis, cells) for axis, cells in matrix.by_axis().items()]
    return parts


def _others(matrix: Matrix, chosen: Sequence[CellVerdict]) -> Table:
    rows: list[Row] = [
        (
            one.name,
            Cell(one.verdict, Style.FAIL if one.verdict == FAILED else Style.PLAIN),
            one.reason,
            repeating(matrix, one),
        )
        for one in chosen
    ]
    return Table(texts("cell", "verdict", "reason", "run it again"), rows)


def _plot(matrix: Matrix) -> HoverPlot:
    places = {id(one): float(i) for i, one in enumerate(matrix.verdicts, start=1)}
    series = []
    for index, model in enumerate(MODELS):
        chosen = [one for one in matrix.verdicts if one.model == model.name]
        passed = [one for one in chosen if one.verdict == PASSED]
        colour, marker, _ = look(index)
        for label, sign, ink, group in (
            (model.name, marker, colour, passed),
            (
                f"{model.name}: not passed",
                "✖",
                FAILED_COLOUR,
                [o for o in chosen if o not in passed],
            ),
        ):
            if group:
                heights = [10.0 ** margin(o) if o.verdict == PASSED else None for o in group]
                x, notes = [places[id(o)] for o in group], [_note(o) for o in group]
                series.append(Series(label, x, heights, ink, sign, notes=notes))
    y = Axis("largest deviation over its bound [1]", log=True)
    return HoverPlot("Each cell over its bound", Axis("cell"), y, series)


def _note(one: CellVerdict) -> str:
    checks = sorted(one.checks, key=lambda check: -check.found)
    lines = [f"{one.axis}: {one.value}", one.verdict + (f": {one.reason}" if one.reason else "")]
    return "\n".join([*lines, *map(_words, checks)])


def _words(check: BoundCheck) -> str:
    return f"{check.name}: {check.found:.2g} of what is allowed"


def _grid(axis: str, cells: Sequence[CellVerdict]) -> str:
    """Return a table of values over models, each cell with its checks as its title."""
    models = [m.name for m in MODELS if any(one.model == m.name for one in cells)]
    by_place = {(one.value, one.model): one for one in cells}
    head = "".join(f'<th scope="col">{escaped(name)}</th>' for name in models)
    rows = "\n".join(
        f'<tr><th scope="row">{escaped(value)}</th>'
        + "".join(_cell(by_place.get((value, model))) for model in models)
        + "</tr>"
        for value in dict.fromkeys(one.value for one in cells)
    )
    title = '<th scope="col">value</th>'
    table = f'<table class="matrix"><thead><tr>{title}{head}</tr></thead><tbody>\n{rows}</tbody>'
    return f'<h3>{escaped(axis)}</h3><div class="wide">{table}</table></div>'


def _cell(one: CellVerdict | None) -> str:
    if one is None:
        return "<td></td>"
    colour = to_hex(cell_colour(one))
    note = escaped(f"{one.model}\n{_note(one)}")
    return f'<td style="background: {colour}" title="{note}">{SIGNS[one.verdict]}</td>'
