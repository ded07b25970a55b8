"""The part of the HTML report on each scene: an index, a plot of FMU on reference, the checks."""

from __future__ import annotations

import math
from collections.abc import Sequence

from slider_resonator.checks.compare import Check
from slider_resonator.checks.overview import Overview
from slider_resonator.checks.validate import Validation
from slider_resonator.checks.verdict import measure_of, title, value_text
from slider_resonator.device.interface import INPUTS, PARAMETERS
from slider_resonator.output.hover_plot import Axis, HoverPlot, Series, plot_html
from slider_resonator.output.html_page import rendered, section
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Cell, Row, Table, numbers, texts, verdict
from slider_resonator.scenes.vocabulary import QUANTITIES

DIGITS = 8
HEIGHT = 240
REFERENCE, FMU = "#f0a58f", "#1f3b57"
MAX_UNFOLDED = 3
"""Number of scenes up to which those that pass are unfolded, too."""
MIN_DECADES = 2.0
"""Width of a sweep from which on its axis is logarithmic."""
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
    scenes: dict[str, list[Check]] = {}
    for check in validation.checks:
        scenes.setdefault(check.scene, []).append(check)
    overviews = {overview.scene: overview for overview in validation.overviews}
    ids = {scene: f"{prefix}-{number}" for number, scene in enumerate(scenes)}
    columns = (*texts("scene", ""), *numbers("checks", "failed", "largest share of a tolerance"))
    rows = [_index_row(Cell(name, target=ids[name]), checks) for name, checks in scenes.items()]
    parts = ["<h3>Scenes</h3>", rendered(Table(columns, rows))]
    for name, checks in scenes.items():
        plot = _of_signal(overviews[name]) if name in overviews else _over_sweep(checks)
        drawn = "" if plot is None else plot_html(plot)
        table = rendered(Table(COLUMNS, [_row(check) for check in checks]))
        failed = sum(not check.passed for check in checks)
        note = f"{failed} of {number_of(len(checks), 'check')} failed" if failed else "pass"
        unfolded = failed > 0 or len(scenes) <= MAX_UNFOLDED
        parts.append(section(ids[name], name, note, drawn + table, unfolded=unfolded))
    return parts


def _index_row(name: Cell, checks: Sequence[Check]) -> Row:
    failed = sum(not check.passed for check in checks)
    worst = max(check.severity for check in checks)
    share = f"{worst:.2g}" if math.isfinite(worst) else "beyond"
    return (name, verdict(not failed), str(len(checks)), str(failed), share)


def _of_signal(overview: Overview) -> HoverPlot:
    times = overview.times.tolist()
    label = _label(overview.quantity, overview.unit)
    series = _pair(times, overview.fmu.tolist(), overview.reference.tolist())
    name = overview.quantity.replace("_", " ")
    return HoverPlot(f"{name}: FMU on reference", Axis("time [s]"), Axis(label), series, HEIGHT)


def _over_sweep(checks: Sequence[Check]) -> HoverPlot | None:
    """Return the plot of the first number that has a reference over the sweep, None without one."""
    swept = [check for check in checks if _is_swept_number(check)]
    if not swept:
        return None
    first, variable = swept[0], next(iter(swept[0].at))
    same = [c for c in swept if (c.quantity, c.against) == (first.quantity, first.against)]
    same.sort(key=lambda check: check.at[variable])
    x = [check.at[variable] for check in same]
    fmu, reference = (
        [value for value in values if isinstance(value, float)]
        for values in ([c.fmu for c in same], [c.reference for c in same])
    )
    name = first.quantity.replace("_", " ")
    return HoverPlot(
        f"{name} over {variable.replace('_', ' ')}: FMU on reference",
        Axis(_label(variable, INPUTS.get(variable) or PARAMETERS[variable]), log=_is_wide(x)),
        Axis(_label(first.quantity, first.unit)),
        _pair(x, fmu, reference),
        HEIGHT,
    )


def _is_wide(x: Sequence[float]) -> bool:
    return x[0] > 0.0 and math.log10(x[-1] / x[0]) >= MIN_DECADES


def _is_swept_number(check: Check) -> bool:
    both = isinstance(check.fmu, float) and isinstance(check.reference, float)
    return both and len(check.at) == 1 and QUANTITIES[check.quantity].kind == "number"


def _label(name: str, unit: str) -> str:
    return f"{name.replace('_', ' ')} [{unit or 1}]"


def _pair(x: Sequence[float], fmu: Sequence[float], reference: Sequence[float]) -> list[Series]:
    return [
        Series("reference", x, reference, REFERENCE, "", 5.0),
        Series("FMU", x, fmu, FMU, "●" if len(fmu) <= 60 else "", 1.3),
    ]


def _row(check: Check) -> Row:
    sizes = ["-" if s is None else f"{s:.2g}" for s in (check.deviation, check.allowed)]
    unit = f" [{check.unit}]" if check.unit not in ("", "1") else ""
    values = [value_text(value, DIGITS) for value in (check.fmu, check.reference)]
    first = (title(check) + unit, verdict(check.passed))
    return (*first, *values, *sizes, measure_of(check), check.why)
