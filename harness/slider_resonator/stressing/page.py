"""The result as a page of HTML: every case over its bound, and a grid for each axis."""

from __future__ import annotations

from collections.abc import Sequence
from math import log10
from pathlib import Path

from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.hover_plot import (
    Axis,
    HoverPlot,
    Series,
    look,
    plot_html,
    write_plot_page,
)
from slider_resonator.output.html_page import escaped, rendered, section
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts, verdict_so_far
from slider_resonator.stressing.case import MODELS, RANDOM, name_of
from slider_resonator.stressing.run import StressResult
from slider_resonator.stressing.verdict import FAILED, MEANINGS, PASSED, SENSITIVE, Verdict

FAR, NEAR = -8.0, 0.0
"""Decimal logarithm of a deviation over its bound, at the ends of the scale."""
SHADES = ((227, 239, 230), (156, 198, 177), (47, 127, 121))
"""Colours of the scale in RGB: far from the bound, half-way, at it."""
REFUSED_COLOUR, FAILED_COLOUR = "#edc46b", "#c8553d"
MAX_SHOWN = 1e6
"""Deviation over its bound above which a point is drawn at this value."""


def write_stress_page(path: Path, results: Sequence[StressResult], provenance: Provenance) -> None:
    """Write the page; HarnessError when that is impossible."""
    parts = [_overview(results), _legend(results), _scale()]
    parts += [part for result in results for part in _of_one_fmu(result)]
    parts.append(provenance_html(provenance))
    write_plot_page(path, "Stress test", parts)


def _overview(results: Sequence[StressResult]) -> str:
    rows: list[Row] = [
        (
            Path(one.fmu).name,
            verdict_so_far(one.failed, one.not_run),
            str(len(one.verdicts)),
            str(one.skipped),
            str(one.not_run),
            f"{one.wall_time:.0f}",
        )
        for one in results
    ]
    counts = numbers("cases", "skipped", "not run", "wall time [s]")
    return rendered(Table((*texts("FMU", "verdict"), *counts), rows))


def _legend(results: Sequence[StressResult]) -> str:
    rows: list[Row] = []
    for name, meaning in MEANINGS.items():
        count = sum(one.counts.get(name, 0) for one in results)
        rows.append((_coloured(name) if count else name, str(count), meaning))
    return rendered(Table((*texts("verdict"), *numbers("cases"), *texts("meaning")), rows))


def _scale() -> str:
    shades = ", ".join(f"rgb{shade}" for shade in SHADES)
    return (
        "<p>A cell in a grid, or a point in the plot, says its checks. It is shaded by its largest "
        "deviation over the allowed one; r is refused by name, F failed.</p>"
        f'<p class="scale">{10.0**FAR:g} '
        f'<i style="background: linear-gradient(to right, {shades})"></i> {10.0**NEAR:g}</p>'
    )


def _of_one_fmu(result: StressResult) -> list[str]:
    parts = [f"<h2>{escaped(Path(result.fmu).name)}</h2>"]
    parts += [f"<p>{escaped(line)}</p>" for line in result.summary.splitlines()]
    for name in (FAILED, *(other for other in MEANINGS if other not in (PASSED, FAILED))):
        chosen = [one for one in result.verdicts if one.verdict == name]
        if chosen:
            anchor = f"{name}-{Path(result.fmu).name}".replace(" ", "-")
            heading, count = name.capitalize(), number_of(len(chosen), "case")
            others: list[Row] = [
                (one.name, _coloured(one.verdict), one.reason, one.command(result.fmu))
                for one in chosen
            ]
            columns = texts("case", "verdict", "reason", "run it again")
            table = rendered(Table(columns, others))
            parts.append(section(anchor, heading, count, table, unfolded=name == FAILED))
    parts += [plot_html(_plot(result)), rendered(_nearest(result))]
    return parts + [_grid(axis, ones) for axis, ones in result.by_axis().items() if axis != RANDOM]


def _coloured(verdict: str) -> Cell:
    return Cell(verdict, Style.FAIL if verdict == FAILED else Style.PLAIN)


def _nearest(result: StressResult) -> Table:
    rows: list[Row] = [
        (model, f"{check.found:.2g}", check.name, case.name)
        for model, case in result.nearest.items()
        if (check := case.nearest)
    ]
    columns = (*texts("model"), *numbers("nearest to its bound"), *texts("in", "case"))
    return Table(columns, rows)


def _plot(result: StressResult) -> HoverPlot:
    series = []
    for index, name in enumerate(map(name_of, MODELS)):
        ink, marker, _ = look(index)
        for label, sign, shown, passed in (
            (name, marker, ink, True),
            (f"{name}: not passed", "✖", FAILED_COLOUR, False),
        ):
            group = [
                (float(place), one)
                for place, one in enumerate(result.verdicts, start=1)
                if one.model == name and (one.verdict == PASSED) == passed
            ]
            if group:
                places, notes = [place for place, _ in group], [_note(one) for _, one in group]
                heights = [_height(one) for _, one in group]
                series.append(Series(label, places, heights, shown, sign, notes=notes))
    y = Axis("largest deviation over its bound [1]", log=True)
    return HoverPlot("Each case over its bound", Axis("case"), y, series)


def _height(one: Verdict) -> float | None:
    """Return the deviation of a case that has one, within the scale where it passed."""
    if one.verdict == PASSED:
        return float(10.0 ** _margin(one))
    far = one.nearest.found if one.nearest else 0.0
    return min(far, MAX_SHOWN) if one.verdict in (FAILED, SENSITIVE) and far > 0.0 else None


def _note(one: Verdict) -> str:
    checks = sorted(one.checks, key=lambda check: -check.found)
    lines = [f"{one.axis}: {one.value}", one.verdict + (f": {one.reason}" if one.reason else "")]
    return "\n".join(
        [*lines, *(f"{check.name}: {check.found:.2g} of what is allowed" for check in checks)]
    )


def _grid(axis: str, cases: Sequence[Verdict]) -> str:
    """Return a table of values over models, each cell with its checks as its title."""
    models = [name for name in map(name_of, MODELS) if any(one.model == name for one in cases)]
    by_place = {(one.value, one.model): one for one in cases}
    head = "".join(f'<th scope="col">{escaped(name)}</th>' for name in models)
    rows = "\n".join(
        f'<tr><th scope="row">{escaped(value)}</th>'
        + "".join(_cell(by_place.get((value, model))) for model in models)
        + "</tr>"
        for value in dict.fromkeys(one.value for one in cases)
    )
    title = '<th scope="col">value</th>'
    table = f'<table class="matrix"><thead><tr>{title}{head}</tr></thead><tbody>\n{rows}</tbody>'
    words = escaped(_checked(cases))
    return f'<h3>{escaped(axis)}</h3><p>{words}</p><div class="wide">{table}</table></div>'


def _checked(cases: Sequence[Verdict]) -> str:
    """Return by what an axis is checked, and which check is nearest to its bound."""
    checks = [check for one in cases for check in one.checks]
    names = ", ".join(dict.fromkeys(check.name for check in checks))
    nearest = max(checks, key=lambda check: check.found, default=None)
    words = f"; nearest to its bound: {nearest.name}, {nearest.found:.2g} of it" if nearest else ""
    return f"{number_of(len(cases), 'case')} checked by {names}{words}"


def _cell(one: Verdict | None) -> str:
    if one is None:
        return "<td></td>"
    note = escaped(f"{one.model}\n{_note(one)}")
    sign = "" if one.verdict == PASSED else "F" if one.verdict == FAILED else "r"
    return f'<td style="background: {_colour(one)}" title="{note}">{sign}</td>'


def _margin(one: Verdict) -> float:
    """Return the largest deviation over its bound, as a decimal logarithm within the scale.

    What a step costs is no deviation and does not count.
    """
    found = one.nearest.found if one.nearest else 0.0
    return min(max(log10(found), FAR), NEAR) if found > 0.0 else FAR


def _colour(one: Verdict) -> str:
    """Return the colour of a case: shaded by its margin where it passed."""
    if one.verdict != PASSED:
        return FAILED_COLOUR if one.verdict == FAILED else REFUSED_COLOUR
    place = 2.0 * (_margin(one) - FAR) / (NEAR - FAR)
    low = min(int(place), 1)
    pairs = zip(SHADES[low], SHADES[low + 1], strict=True)
    return f"rgb{tuple(round(a + (place - low) * (b - a)) for a, b in pairs)}"
