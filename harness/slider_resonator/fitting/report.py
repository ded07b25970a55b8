"""What a fit says: text, table, picture, page, and the device file to go on with."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from math import exp, isfinite
from pathlib import Path

import numpy as np

from slider_resonator.fitting.fit import Fit, FittedParameter
from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.atomic import write_csv, write_text
from slider_resonator.output.html_page import rendered, write_page
from slider_resonator.output.plot_style import png_data_uri, save
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
    if one.deviation is None:
        return f"{one.value:.8g}", "", ""
    if one.low is None or one.high is None:
        return f"{one.value:.3g}", *one.interval(2)
    digits = max(2, 2 - round(np.log10(max((one.high - one.low) / abs(one.value or 1.0), 1e-9))))
    return f"{one.value:.{digits + 1}g}", *one.interval(digits)


def sentences(fit: Fit) -> list[str]:
    """Return what there is to say beside the table."""
    count, free = len(fit.measured), len(fit.parameters)
    lines = [f"{count} numbers, {free} free parameters"]
    lines.append(f"friction on {number_of(fit.device.friction_faces, 'face')} (friction_faces)")
    if fit.scale is None:
        solved = "not solved" if fit.unmet else "solved, without intervals"
        lines.append(f"as many parameters as numbers: {solved}")
    elif fit.measurements.knows_deviations:
        lines.append(
            f"residuals have {fit.scale:.3g} times the stated standard deviation"
            + (": the model or the stated deviations do not fit" if fit.scale > 2.0 else "")
        )
    lines += fit.unmet_numbers()
    quantities = np.array(fit.measurements.quantities)
    for quantity in dict.fromkeys(quantities.tolist()):
        own = quantities == quantity
        off = float(np.sqrt(np.nanmean((fit.predicted - fit.measured)[own] ** 2)))
        lines.append(f"{quantity} is off by {fit.measurements.shown(quantity, off)} (rms)")
    missing = int(np.count_nonzero(~np.isfinite(fit.predicted)))
    if missing:
        lines.append(f"at {missing} of the points the fitted device has no steady motion")
    lines += [_open(one.factors, one.spread) for one in fit.open_directions]
    lines.append(f"{fit.starts_agreeing} of {fit.starts} starts led to this minimum")
    at_bound = [one.name for one in fit.parameters if one.at_bound]
    if at_bound:
        lines.append(f"at a bound: {', '.join(at_bound)}")
    return [*lines, *(f"note: {note}" for note in fit.notes)]


def _open(factors: Mapping[str, float], spread: float) -> str:
    parts = ", ".join(f"{name} x {exp(0.1 * part):.3g}" for name, part in factors.items())
    reach = "nothing" if not isfinite(spread) else "too little"
    alone = "is" if len(factors) == 1 else "together are"
    return f"the data say {reach} of {' and '.join(factors)}: {parts} {alone} hardly seen"


def write_report(fit: Fit, folder: Path, title: str, provenance: Provenance) -> list[Path]:
    """Write device.toml, fit.png, residuals.csv and fit.html into a folder; return their paths."""
    paths = [folder / name for name in ("device.toml", "fit.png", "residuals.csv", "fit.html")]
    device, picture, table, page = paths
    open_names = [one.name for one in fit.parameters if one.is_open]
    note = f"# left open by the data: {', '.join(open_names)}\n" if open_names else ""
    write_text(device, note + to_toml(fit.device, title))
    figure = fit.figure()
    save(figure, picture)
    header = ("quantity", "measured", "predicted", "residual_over_deviation", "source", "row")
    numbers_of = (fit.measured, fit.predicted, fit.residuals)
    quantities, *where = zip(*fit.measurements.places, strict=True)
    columns = (column.tolist() for column in numbers_of)
    write_csv(table, header, zip(quantities, *columns, *where, strict=True))
    said = "".join(f"<li>{escape(line)}</li>" for line in sentences(fit))
    parts = [
        rendered(parameter_table(fit)),
        f"<ul>{said}</ul>",
        f'<img alt="measurements and fit" src="{png_data_uri(figure)}">',
        provenance_html(provenance),
    ]
    write_page(page, title, parts)
    return paths
