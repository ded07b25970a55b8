"""What a fit says: text, table, picture, page, and the device file to go on with."""

from html import escape
from pathlib import Path

import numpy as np

from slider_resonator.fitting.result import Fit
from slider_resonator.fmu.provenance import Provenance, provenance_html
from slider_resonator.output.files import write_csv, write_text
from slider_resonator.output.html_page import rendered, write_page
from slider_resonator.output.plot_style import png_data_uri, save
from slider_resonator.output.table import Table, numbers, texts
from slider_resonator.scenes.device_file import to_toml

FILES = ("device.toml", "fit.png", "residuals.csv", "fit.html")
"""What a report consists of."""


def parameter_table(fit: Fit) -> Table:
    """Return estimates and intervals; what the data leave open gets no digits."""
    rows = [
        (one.name, *one.texts(fit.scale is None), one.unit, f"{one.start:.6g}")
        for one in fit.parameters
    ]
    columns = (*texts("parameter"), *numbers("estimate", "95 % from", "to"), *texts("unit"))
    return Table((*columns, *numbers("start")), rows)


def write_report(fit: Fit, folder: Path, title: str, provenance: Provenance) -> list[Path]:
    """Write `FILES` into a folder; return their paths."""
    paths = [folder / name for name in FILES]
    device, picture, table, page = paths
    open_names = [one.name for one in fit.parameters if one.is_open]
    note = f"# left open by the data: {', '.join(open_names)}\n" if open_names else ""
    write_text(device, note + to_toml(fit.device, title))
    figure = fit.figure()
    save(figure, picture)
    points = fit.measurements.points
    settings = list(dict.fromkeys(name for point in points for name in point.values))
    found = np.column_stack([fit.measured, fit.predicted, fit.residuals]).tolist()
    # A row for each number; what a steady measurement set is in columns of its own.
    rows = [
        (one.quantity, *three, one.source, one.row, *(one.values.get(s, "") for s in settings))
        for one, three in zip(points, found, strict=True)
    ]
    header = ("quantity", "measured", "predicted", "residual_over_deviation", "source", "row")
    write_csv(table, (*header, *settings), rows)
    said = "".join(f"<li>{escape(line)}</li>" for line in fit.sentences())
    parts = [
        rendered(parameter_table(fit)),
        f"<ul>{said}</ul>",
        f'<img alt="measurements and fit" src="{png_data_uri(figure)}">',
        provenance_html(provenance),
    ]
    write_page(page, title, parts)
    return paths
