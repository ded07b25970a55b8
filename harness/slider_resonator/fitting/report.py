"""What a fit says: text, table, picture, page, and the device file to go on with."""

from html import escape
from pathlib import Path

import numpy as np

from slider_resonator.fitting.fit import Fit, FittedParameter
from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.atomic import write_csv, write_text
from slider_resonator.output.html_page import rendered, write_page
from slider_resonator.output.plot_style import png_data_uri, save
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
    said = "".join(f"<li>{escape(line)}</li>" for line in fit.sentences())
    parts = [
        rendered(parameter_table(fit)),
        f"<ul>{said}</ul>",
        f'<img alt="measurements and fit" src="{png_data_uri(figure)}">',
        provenance_html(provenance),
    ]
    write_page(page, title, parts)
    return paths
