"""Verdicts as one HTML file that needs no other, with pictures of what differs."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from slider_resonator.checks.compare import Check, Curves
from slider_resonator.checks.reports.headline import headline
from slider_resonator.checks.validate import Validation, provenance_of_all, worst_of_sweeps
from slider_resonator.checks.verdict import TITLE, sentence, sizes, title, value_text
from slider_resonator.device.interface import SETTABLE
from slider_resonator.fmu.provenance import provenance_html
from slider_resonator.output.hover_plot import Axis, HoverPlot, Series, plot_html
from slider_resonator.output.html_page import escaped, folded, rendered, section, write_page
from slider_resonator.output.plot_style import range_after_start
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Cell, Row, Table, numbers, texts, verdict
from slider_resonator.scenes.vocabulary import QUANTITIES


def write_html(
    path: Path, validations: Sequence[Validation], error: str = "", *, title: str = TITLE
) -> None:
    """Write the report; `error` is what stopped the command before it reached an FMU.

    Raises HarnessError when the file cannot be written.
    """
    parts = [f'<p class="fail">Could not run: {escaped(error)}</p>'] if error else []
    for number, validation in enumerate(validations):
        parts += _section(number, validation)
    parts.append(provenance_html(provenance_of_all(validations)))
    write_page(path, title, parts)


def _section(number: int, validation: Validation) -> list[str]:
    colour = "pass" if validation.passed else "fail"
    parts = [
        f"<h2>{escaped(validation.fmu)}</h2>",
        f'<p><span class="{colour}">{validation.outcome}</span>: {validation.count}</p>',
    ]
    for heading, rows in headline(validation.checks):
        cells = [(name, passed, value, off) for name, value, off, passed in rows]
        answer = Table((*texts("", ""), *numbers("", "")), cells)
        parts.append(f"<h3>{escaped(heading.text)}</h3>{rendered(answer)}")
    if validation.without:
        parts.append(f"<p>{escaped(validation.without)}</p>")
    for failure in validation.run_failures:
        parts.append(f'<p class="fail">{escaped(failure.where + failure.reason)}</p>')
    pictures = {id(curves.check): curves for curves in validation.curves}
    for index, (check, _) in enumerate(worst_of_sweeps(validation.failed)):
        # A very faulty FMU fails everywhere: the first 40 have pictures.
        parts += _failure(check, pictures.get(id(check)) if index < 40 else None)
    if validation.checks:
        parts += scene_sections(validation, f"scene-{number}")
    if validation.not_applied:
        columns = texts("scene", "quantity", "not applicable because")
        table = Table(columns, validation.inapplicable)
        label = "not applicable: " + number_of(len(validation.not_applied), "check")
        parts.append(folded(label, rendered(table)))
    return parts


def _failure(check: Check, curves: Curves | None) -> list[str]:
    parts = [
        f"<h3>{escaped(check.scene)}: {escaped(title(check))}</h3>",
        f'<p>{escaped(sentence(check))}<br><span class="note">{escaped(check.why)}</span></p>',
    ]
    if curves is not None:
        plots = _of_signals(curves.thinned(), "")
        if check.first_time is not None and len(curves.times) > 2 * ZOOM_POINTS:
            first = int(np.searchsorted(curves.times, check.first_time))
            near = slice(max(0, first - ZOOM_POINTS), first + ZOOM_POINTS)
            plots += _of_signals(curves.part(near), f", from {check.first_time:.9g} s on")
        parts += map(plot_html, plots)
    return parts


ZOOM_POINTS = 64
"""Points shown on each side of the first one outside the tolerance."""
REFERENCE, FMU = "#f0a58f", "#1f3b57"
MAX_UNFOLDED = 3
"""Number of scenes up to which those that pass are unfolded, too."""
COLUMNS = (
    *texts("quantity", ""),
    *numbers("FMU", "reference", "off by", "allowed"),
    *texts("in", "why"),
)
"""The verdict is beside the name, where a phone shows it, too."""


def scene_sections(validation: Validation, prefix: str) -> list[str]:
    """Return an index of the scenes that were judged, and a section for each of them.

    The ids of the sections begin with `prefix`, which is unique in the page.
    """
    scenes = validation.scenes
    overviews = {overview.check.scene: overview for overview in validation.overviews}
    ids = {scene: f"{prefix}-{number}" for number, scene in enumerate(scenes)}
    columns = (*texts("scene", ""), *numbers("checks", "failed", "largest share of a tolerance"))
    rows: list[Row] = []
    sections: list[str] = []
    for name, checks in scenes.items():
        failed = sum(not check.passed for check in checks)
        worst = max(check.severity for check in checks)
        share = f"{worst:.2g}" if math.isfinite(worst) else "beyond"
        counts = (str(len(checks)), str(failed), share)
        rows.append((Cell(name, target=ids[name]), verdict(not failed), *counts))
        plots = _of_signals(overviews[name], "") if name in overviews else _over_sweep(checks)
        drawn = "".join(map(plot_html, plots))
        table = rendered(Table(COLUMNS, [_row(check) for check in checks]))
        note = f"{failed} of {number_of(len(checks), 'check')} failed" if failed else "pass"
        unfolded = failed > 0 or len(scenes) <= MAX_UNFOLDED
        sections.append(section(ids[name], name, note, drawn + table, unfolded=unfolded))
    return ["<h3>Scenes</h3>", rendered(Table(columns, rows)), *sections]


def _of_signals(curves: Curves, where: str) -> list[HoverPlot]:
    times, fmu, reference = curves.times, curves.fmu, curves.reference
    shown, words = range_after_start(times, fmu, reference)
    name = curves.check.quantity.replace("_", " ")
    return _overlay(
        f"{name}: FMU on reference{where}" + (f"; {words}" if words else ""),
        Axis("time [s]"),
        Axis(_label(curves.check.quantity, curves.check.unit), range=shown),
        *(times.tolist(), fmu.tolist(), reference.tolist()),
    )


def _over_sweep(checks: Sequence[Check]) -> list[HoverPlot]:
    """Return the plots of the first number that has a reference over the sweep, if there is one."""
    swept = [
        (check, check.fmu, check.reference)
        for check in checks
        if isinstance(check.fmu, float)
        and isinstance(check.reference, float)
        and len(check.at) == 1
        and QUANTITIES[check.quantity].kind == "number"
    ]
    if not swept:
        return []
    (first, _, _), (variable,) = swept[0], swept[0][0].at
    points = [
        (check.at[variable], fmu, reference)
        for check, fmu, reference in sorted(swept, key=lambda one: one[0].at[variable])
        if (check.quantity, check.against) == (first.quantity, first.against)
    ]
    x, fmu, reference = ([*column] for column in zip(*points, strict=True))
    is_wide = x[0] > 0.0 and x[-1] >= 100.0 * x[0]
    name = first.quantity.replace("_", " ")
    return _overlay(
        f"{name} over {variable.replace('_', ' ')}: FMU on reference",
        Axis(_label(variable, SETTABLE[variable]), log=is_wide),
        Axis(_label(first.quantity, first.unit)),
        *(x, fmu, reference),
    )


def _overlay(
    title: str, x_axis: Axis, y_axis: Axis, x: list[float], fmu: list[float], reference: list[float]
) -> list[HoverPlot]:
    """Return the plot of FMU and reference, and below it that of their difference."""
    marker = "●" if len(fmu) <= 60 else ""  # a mark for each point of a few
    both = [
        Series("reference", x, reference, REFERENCE, "", 5.0),
        Series("FMU", x, fmu, FMU, marker, 1.3),
    ]
    # Three digits are more than such a plot shows, and a report has a plot for each scene.
    off = [float(f"{one - other:.3g}") for one, other in zip(fmu, reference, strict=True)]
    difference = [Series("FMU - reference", x, off, FMU, marker, 1.3)]
    below = Axis(f"difference {y_axis.label[y_axis.label.rindex('[') :]}")
    return [
        HoverPlot(title, x_axis, y_axis, both, 240),
        HoverPlot("FMU - reference", x_axis, below, difference, 170),
    ]


def _label(name: str, unit: str) -> str:
    return f"{name.replace('_', ' ')} [{unit or 1}]"


def _row(check: Check) -> Row:
    *counted, measure = sizes(check)
    shown = ["-" if s is None else f"{s:.2g}" for s in counted]
    unit = f" [{check.unit}]" if check.unit not in ("", "1") else ""
    values = [value_text(value, 8) for value in (check.fmu, check.reference)]
    first = (title(check) + unit, verdict(check.passed))
    return (*first, *values, *shown, measure, check.why)
