"""What a fit says: text, table, picture, page, and the device file to go on with."""

from __future__ import annotations

from collections.abc import Mapping
from math import exp, isfinite
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from slider_resonator.device.interface import VARIABLES
from slider_resonator.fitting.fit import Fit, FittedParameter
from slider_resonator.fitting.measurements import Point
from slider_resonator.fmu.provenance import Provenance, provenance_html
from slider_resonator.output.atomic import write_csv, write_text
from slider_resonator.output.html_page import rendered, write_page
from slider_resonator.output.plot_style import COLOURS, png_data_uri, save, style
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Table, numbers, texts
from slider_resonator.scenes.device_file import to_toml

OPEN = "left open"


def parameter_table(fit: Fit) -> Table:
    """Return estimates and intervals; what the data leave open gets no digits."""
    rows = [(one.name, *_numbers(one), one.unit, f"{one.start:.6g}") for one in fit.parameters]
    columns = (*texts("parameter"), *numbers("estimate", "95 % from", "to"), *texts("unit"))
    return Table((*columns, *numbers("start")), rows)


def _numbers(one: FittedParameter) -> tuple[str, str, str]:
    if one.is_open:
        return OPEN, "", ""
    if one.low is None or one.high is None:
        return f"{one.value:.8g}", "", ""
    digits = max(2, 2 - round(np.log10(max((one.high - one.low) / abs(one.value or 1.0), 1e-9))))
    return (f"{one.value:.{digits + 1}g}", f"{one.low:.{digits}g}", f"{one.high:.{digits}g}")


def sentences(fit: Fit) -> list[str]:
    """Return what there is to say beside the table."""
    count, free = len(fit.measured), len(fit.parameters)
    lines = [f"{count} numbers, {free} free parameters"]
    lines.append(f"friction on {number_of(fit.device.friction_faces, 'face')} (friction_faces)")
    if fit.scale is None:
        lines.append("as many parameters as numbers: solved, without intervals")
    elif fit.measurements.knows_deviations:
        lines.append(
            f"residuals have {fit.scale:.3g} times the stated standard deviation"
            + (": the model or the stated deviations do not fit" if fit.scale > 2.0 else "")
        )
    for quantity in dict.fromkeys(fit.measurements.quantities):
        own = np.array(fit.measurements.quantities) == quantity
        off = float(np.sqrt(np.nanmean((fit.predicted - fit.measured)[own] ** 2)))
        lines.append(f"{quantity} is off by {off:.3g} {VARIABLES[quantity].unit} (rms)")
    missing = int(np.count_nonzero(~np.isfinite(fit.predicted)))
    if missing:
        lines.append(f"at {missing} of the points the fitted device has no steady motion")
    lines += [_open(one.factors, one.spread) for one in fit.open_directions]
    lines.append(f"{fit.starts_agreeing} of {fit.starts} starts led to this minimum")
    at_bound = [one.name for one in fit.parameters if one.value in (one.low, one.high)]
    if at_bound:
        lines.append(f"at a bound: {', '.join(at_bound)}")
    return lines


def _open(factors: Mapping[str, float], spread: float) -> str:
    parts = ", ".join(f"{name} x {exp(0.1 * part):.3g}" for name, part in factors.items())
    reach = "nothing" if not isfinite(spread) else "too little"
    alone = "is" if len(factors) == 1 else "together are"
    return f"the data say {reach} of {' and '.join(factors)}: {parts} {alone} hardly seen"


def draw(fit: Fit) -> Figure:
    """Draw data and fit above, residuals below: points over what varies most, runs over time."""
    panels = [*_point_panels(fit), *_run_panels(fit)]
    with style():
        figure = Figure((3.6 + 3.2 * len(panels), 5.2), layout="constrained")
        axes = figure.subplots(
            2, len(panels), squeeze=False, sharex="col", height_ratios=[2.0, 1.0]
        )
        for column, (label, title, x, measured, predicted, residuals) in enumerate(panels):
            above, below = axes[0][column], axes[1][column]
            above.plot(x, measured, "o", ms=4, color=COLOURS["theory"], label="measured")
            order = np.argsort(x, kind="stable")
            is_line = len(np.unique(x)) == len(x)
            mark = "-" if is_line else "+"
            above.plot(x[order], predicted[order], mark, color=COLOURS["slow"], label="fit")
            above.set_title(title)
            above.legend()
            below.axhline(0.0, color="0.6", lw=0.8)
            below.plot(x, residuals, "o", ms=3, color=COLOURS["slow"])
            below.set_xlabel(label)
            below.set_ylabel("residual / deviation")
    return figure


Panel = tuple[str, str, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def _point_panels(fit: Fit) -> list[Panel]:
    points = fit.measurements.points
    panels: list[Panel] = []
    for quantity in dict.fromkeys(point.quantity for point in points):
        rows = [i for i, point in enumerate(points) if point.quantity == quantity]
        label, x = _abscissa([points[i] for i in rows])
        title = f"{quantity}, {VARIABLES[quantity].unit}"
        columns = (fit.measured[rows], fit.predicted[rows], fit.residuals[rows])
        panels.append((label, title, x, *columns))
    return panels


def _abscissa(points: list[Point]) -> tuple[str, np.ndarray]:
    """Return the variable with most values among the points, or their numbers."""
    names = dict.fromkeys(name for point in points for name in point.values)
    counts = {name: len({point.values.get(name) for point in points}) for name in names}
    if not counts or max(counts.values()) < 2:
        return "number of the measurement", np.arange(1.0, len(points) + 1.0)
    name = max(counts, key=lambda one: counts[one])
    start = VARIABLES[name].start or 0.0
    values = [point.values.get(name, start) for point in points]
    return f"{name}, {VARIABLES[name].unit}", np.array(values)


def _run_panels(fit: Fit) -> list[Panel]:
    begin = len(fit.measurements.points)
    panels: list[Panel] = []
    for run in fit.measurements.runs:
        for name, column in run.outputs.items():
            there = np.isfinite(column)
            own = slice(begin, begin + int(there.sum()))
            begin = own.stop
            title = f"{name}, {VARIABLES[name].unit} ({Path(run.source).name})"
            columns = (fit.measured[own], fit.predicted[own], fit.residuals[own])
            panels.append(("time, s", title, run.schedule.times[there], *columns))
    return panels


def write_report(fit: Fit, folder: Path, title: str, provenance: Provenance) -> list[Path]:
    """Write device.toml, fit.png, residuals.csv and fit.html into a folder; return their paths."""
    paths = [folder / name for name in ("device.toml", "fit.png", "residuals.csv", "fit.html")]
    device, picture, table, page = paths
    open_names = [one.name for one in fit.parameters if one.is_open]
    note = f"# left open by the data: {', '.join(open_names)}\n" if open_names else ""
    write_text(device, note + to_toml(fit.device, title))
    figure = draw(fit)
    save(figure, picture)
    header = ("quantity", "measured", "predicted", "residual_over_deviation")
    numbers_of = (fit.measured, fit.predicted, fit.residuals)
    columns = (column.tolist() for column in numbers_of)
    write_csv(table, header, zip(fit.measurements.quantities, *columns, strict=True))
    said = "".join(f"<li>{line}</li>" for line in sentences(fit))
    parts = [
        rendered(parameter_table(fit)),
        f"<ul>{said}</ul>",
        f'<img alt="measurements and fit" src="{png_data_uri(figure)}">',
        provenance_html(provenance),
    ]
    write_page(page, title, parts)
    return paths
