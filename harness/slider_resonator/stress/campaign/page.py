"""Campaigns as a page of HTML: every case over its number, each point to be hovered."""

from __future__ import annotations

import math
import shlex
from collections.abc import Sequence
from pathlib import Path

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
from slider_resonator.output.html_page import escaped, rendered, write_page
from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts, verdict_so_far
from slider_resonator.stress.campaign.campaign_run import Campaign
from slider_resonator.stress.campaign.verdict import (
    FAILED,
    NO_REFERENCE,
    PASSED,
    REFUSED,
    SENSITIVE,
    CaseVerdict,
)

FAILED_COLOUR, GREY = "#b3261e", "#78909c"
MIN_SHOWN = 1e-8
"""Error over tolerance below which a point is drawn at this value."""
MEANINGS = {
    PASSED: "every signal is within the errors that its numerics state",
    FAILED: "a signal is further off, is not finite, or the FMU crashed or hung",
    REFUSED: "the FMU refused a value or a step",
    SENSITIVE: "the reference, with values off by the allowed error, departs as far",
    NO_REFERENCE: "the reference could not follow the motion",
}
"""Verdict to what it means."""


def write_campaigns(path: Path, campaigns: Sequence[Campaign], provenance: Provenance) -> None:
    """Write the page; HarnessError when that is impossible."""
    parts = [_overview(campaigns), rendered(_legend(campaigns))]
    parts += [part for campaign in campaigns for part in _campaign(campaign)]
    parts.append(provenance_html(provenance))
    write_page(path, "Random campaign", parts, hover_scripts(), hover_style())


def repeating(campaign: Campaign, number: int) -> str:
    """Return the command that runs one case again and prints its values."""
    fmu = shlex.quote(campaign.fmu)
    return f"slider-resonator campaign {fmu} --seed {campaign.seed} --case {number}"


def _overview(campaigns: Sequence[Campaign]) -> str:
    rows: list[Row] = [
        (
            Path(one.fmu).name,
            verdict_so_far(one.failed, one.not_run),
            str(one.seed),
            str(len(one.verdicts)),
            str(one.not_run),
            f"{one.wall_time:.0f}",
        )
        for one in campaigns
    ]
    columns = (*texts("FMU", "verdict"), *numbers("seed", "cases", "not run", "wall time [s]"))
    return rendered(Table(columns, rows))


def _legend(campaigns: Sequence[Campaign]) -> Table:
    rows: list[Row] = []
    for name, meaning in MEANINGS.items():
        count = sum(campaign.counts.get(name, 0) for campaign in campaigns)
        style = Style.FAIL if name == FAILED and count else Style.PLAIN
        rows.append((Cell(name, style), str(count), meaning))
    return Table((*texts("verdict"), *numbers("cases"), *texts("meaning")), rows)


def _campaign(campaign: Campaign) -> list[str]:
    name = escaped(Path(campaign.fmu).name)
    parts = [f"<h2>{name}</h2>", plot_html(_plot(campaign)), rendered(_nearest(campaign))]
    others = [one for one in campaign.verdicts if one.verdict in (FAILED, REFUSED, SENSITIVE)]
    if others:
        parts += [
            "<h3>Failed, refused and sensitive cases</h3>",
            rendered(_others(campaign, others)),
        ]
    without = [one for one in campaign.verdicts if one.verdict == NO_REFERENCE]
    if without:
        parts += ["<h3>Cases without a reference</h3>", rendered(_others(campaign, without))]
    return parts


def _plot(campaign: Campaign) -> HoverPlot:
    models = list(dict.fromkeys(one.model for one in campaign.verdicts))
    series = [
        _points(campaign, model, look(index)[0], look(index)[1], model, passed=True)
        for index, model in enumerate(models)
    ]
    series += [
        _points(campaign, f"{model}: not passed", FAILED_COLOUR, "✖", model, passed=False)
        for model in models
    ]
    numbers_ = [one.number for one in campaign.verdicts]
    series.append(
        Series(
            *("tolerance", [min(numbers_, default=0), max(numbers_, default=1)], [1.0, 1.0], GREY),
            width=1.4,
            dash=(8, 4),
        )
    )
    y = Axis("largest error over its tolerance [1]", log=True)
    shown = [one for one in series if one.x]
    return HoverPlot("Error over tolerance of each case", Axis("case"), y, shown)


def _points(
    campaign: Campaign, label: str, colour: str, marker: str, model: str, *, passed: bool
) -> Series:
    chosen = [
        one for one in campaign.verdicts if one.model == model and (one.verdict == PASSED) == passed
    ]
    return Series(
        label,
        [float(one.number) for one in chosen],
        [_height(one) for one in chosen],
        colour,
        marker,
        notes=[_note(campaign, one) for one in chosen],
    )


def _height(one: CaseVerdict) -> float | None:
    """The error over the tolerance where it is a number, None where there is none."""
    if one.verdict in (REFUSED, NO_REFERENCE) or not math.isfinite(one.found):
        return None
    if one.verdict == FAILED and one.found == 0.0:
        return None  # it crashed or hung
    return max(one.found, MIN_SHOWN)


def _note(campaign: Campaign, one: CaseVerdict) -> str:
    lines = [one.verdict + (f", {one.signal}" if one.signal else "")]
    lines += [one.reason] if one.reason else []
    return "\n".join([*lines, repeating(campaign, one.number)])


def _nearest(campaign: Campaign) -> Table:
    rows: list[Row] = [
        (
            one.model,
            f"{one.found:.2g}",
            one.signal,
            str(one.number),
            repeating(campaign, one.number),
        )
        for one in campaign.worst.values()
    ]
    columns = (
        *texts("model"),
        *numbers("largest error over its tolerance"),
        *texts("in"),
        *numbers("case"),
        *texts("run it again"),
    )
    return Table(columns, rows)


def _others(campaign: Campaign, chosen: Sequence[CaseVerdict]) -> Table:
    rows: list[Row] = [
        (
            str(one.number),
            one.model,
            Cell(one.verdict, Style.FAIL if one.verdict == FAILED else Style.PLAIN),
            one.reason,
            repeating(campaign, one.number),
        )
        for one in chosen
    ]
    return Table((*numbers("case"), *texts("model", "verdict", "reason", "run it again")), rows)
