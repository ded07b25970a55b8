"""The figures at the top, and the tables that lead from need to model to cost."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from slider_resonator.device.model import LAWS
from slider_resonator.output import html_page, markdown
from slider_resonator.output.files import write_marked
from slider_resonator.output.table import Table, numbers, texts
from slider_resonator.trading.result import AVERAGED, PEER, RESOLVED, Row, Trade, cheapest

TARGETS = (("mean_velocity", 1e-2), ("position", 1e-9))
"""Quantity, and the error at which costs are compared."""
ROUNDS_UP = 0.9995
"""Share of a unit that three digits round to the whole unit."""
CLASSES = {AVERAGED: "averages and leaps", RESOLVED: "resolved", PEER: "peers"}


@dataclass(frozen=True)
class Standing:
    """The cheapest method of a class at an error, None where none reaches it.

    `ratio` is its cost over that of the resolved one, repeat by repeat: median, minimum, maximum.
    """

    quantity: str
    error: float
    kind: str
    row: Row | None
    ratio: tuple[float, float, float] | None


def standings(trade: Trade) -> list[Standing]:
    """Return the standing of every class at every target."""
    found = []
    for quantity, error in TARGETS:
        rows = trade.candidates(quantity)
        against = cheapest([row for row in rows if row.kind == RESOLVED], quantity, error)
        for kind in CLASSES:
            row = cheapest([row for row in rows if row.kind == kind], quantity, error)
            ratio = None
            if row is not None and against is not None:
                pairs = zip(row.cpu, against.cpu, strict=False)
                ratios = [ours / theirs for ours, theirs in pairs]
                ratio = (median(ratios), min(ratios), max(ratios))
            found.append(Standing(quantity, error, kind, row, ratio))
    return found


def sentence(standing: Standing) -> str:
    """Return a standing in words."""
    name = CLASSES[standing.kind]
    if standing.row is None:
        return f"{name}: not reached"
    row = standing.row
    words = f"{name}: {duration(row.cost)} a simulated second ({row.method})"
    if standing.ratio is None or standing.kind == RESOLVED:
        return words
    middle, low, high = standing.ratio
    if middle < 1.0:
        shares = f"{1.0 / middle:.3g} times cheaper than resolved"
        return f"{words}, {shares} ({1.0 / high:.3g} to {1.0 / low:.3g})"
    return f"{words}, {middle:.3g} times the cost of resolved ({low:.3g} to {high:.3g})"


def comparisons(trade: Trade) -> list[tuple[str, list[str]]]:
    """Return the standings in words: the target, and a sentence for each class."""
    by_target: dict[str, list[str]] = {}
    for one in standings(trade):
        size = f"{100.0 * one.error:g} %" if one.error >= 1e-3 else f"{one.error:.0e}"
        target = f"at an error of {size} in {one.quantity.replace('_', ' ')}"
        by_target.setdefault(target, []).append(sentence(one))
    return list(by_target.items())


def duration(seconds: float) -> str:
    """Return a CPU time in three digits, with a unit."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= ROUNDS_UP * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


BEGIN, END = "<!-- trade -->", "<!-- end of trade -->"
SUFFIXES = (".md", ".html")
NATIVE, PYTHON = "native FMU, ", "Python FMU, "
"""Beginnings of the methods of the two FMUs of FMI 2.0."""
NEEDS = (
    ("steady_velocity", 1e-2),
    ("steady_velocity", 1e-6),
    ("blocking_force", 1e-2),
    ("blocking_force", 1e-6),
    ("beat_frequency", 1e-2),
    ("mean_velocity", 1e-2),
    ("mean_velocity", 1e-6),
    ("position", 1e-2),
    ("position", 1e-4),
    ("position", 1e-9),
    ("event_times", 1e-6),
)
"""Quantity and error; a scene without the quantity has no such row."""
COLUMNS = (
    *(*texts("need"), *numbers("within"), *texts("model")),
    *(*numbers("error", "native FMU", "Python FMU"), *texts("cheapest peer")),
)


def choices(trade: Trade) -> list[tuple[str, ...]]:
    """Return the cheapest method for every need of a scene, in the order of `COLUMNS`.

    The native FMU decides the model; the Python FMU, which holds inputs over each step, may not
    meet the need with it.
    """
    found = []
    for quantity, error in NEEDS:
        rows = trade.candidates(quantity)
        if not rows:
            continue
        native = cheapest([row for row in rows if row.method.startswith(NATIVE)], quantity, error)
        peer = cheapest([row for row in rows if row.kind == PEER], quantity, error)
        model, off = "none", ""
        if native is not None:
            model = native.method.removeprefix(NATIVE)
            off = f"{native.errors[quantity]:.0e}"
        twin = [row for row in rows if row.method == PYTHON + model]
        costs = [_cost(row) for row in (native, cheapest(twin, quantity, error), peer)]
        if peer is not None:
            costs[2] += f" ({peer.method})"
        found.append((quantity.replace("_", " "), f"{error:.0e}", model, off, *costs))
    return found


def _cost(row: Row | None) -> str:
    if row is None:
        return "not reached"
    return duration(row.cost) + (" / s" if row.answer == "run" else "")


def write_choices(path: Path, trades: Sequence[Trade]) -> None:
    """Write the tables of all scenes between the marks of a page, Markdown or HTML by its suffix.

    Raises HarnessError when the file cannot be written, or has marks that are no pair.
    """
    parts = []
    for trade in trades:
        table = Table(COLUMNS, choices(trade))
        if path.suffix == ".md":
            heading = markdown.escaped(title(trade))
            parts.append(f"\n**{heading}**\n\n{markdown.rendered(table)}\n")
        else:
            heading = html_page.escaped(title(trade))
            parts.append(f"<h3>{heading}</h3>\n{html_page.rendered(table)}")
    write_marked(path, "\n".join(parts), BEGIN, END)


def title(trade: Trade) -> str:
    """Return the title of a table."""
    return f"{trade.title} (scene {trade.scene}, {LAWS[trade.friction_law]} friction)"
