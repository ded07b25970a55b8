"""The data of a trade: rows, omissions, CSV files, and the cheapest methods at an error.

These are compared in words, and in tables that lead from need to model to cost.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from slider_resonator.device.model import LAWS
from slider_resonator.output import html_page, markdown
from slider_resonator.output.files import write_csv, write_marked
from slider_resonator.output.readable import number_of
from slider_resonator.output.shown import Shown, Tabular
from slider_resonator.output.table import Table, numbers, texts

QUANTITIES: Mapping[str, str] = {
    "mean_velocity": "mean velocity over a drive period, share of its peak",
    "slow_displacement": "position averaged over a drive period, share of its peak",
    "position": "instantaneous position, share of its peak",
    "velocity": "instantaneous velocity, share of its peak",
    "event_times": "time of the last event, in drive periods",
    "beat_frequency": "frequency of the beat, share of it",
    "steady_velocity": "steady velocity by shooting, share of it",
    "blocking_force": "blocking force by shooting, share of it",
}
"""Every measured error and its quantity."""
AVERAGED, RESOLVED, PEER = "averaged", "resolved", "peer"
"""Kinds of method: our averages and leaps, our resolved motion, and all others."""


@dataclass(frozen=True)
class Row:
    """One method at one setting on one scene; without a scene what a method is, not yet measured.

    The name `method` begins with its `family`. `step` is the communication step in drive periods,
    `averaging_order` that of fidelity 0, in an FMU that has a choice, and of predictions.

    `answer` is `run`, with the errors of a trajectory over `periods` drive periods, or
    `steady_velocity` or `blocking_force`, with that error alone. `cpu` (s) holds every repeat, per
    simulated second of a run and per answer otherwise, and `start_cpu` (s) what initialisation took
    besides. Of a run `steps` counts the communication steps of an FMU or an integrator's own,
    `evaluations` those of the equations, `events` the located ones, or the reversals where a method
    reports no others. What a method does not have or does not report is None.
    """

    kind: str
    family: str
    method: str
    friction_law: int
    fidelity: int | None = None
    step: float | None = None
    tolerance: float | None = None
    averaging_order: int | None = None
    scene: str = ""
    answer: str = "run"
    periods: int = 0
    cpu: tuple[float, ...] = ()
    errors: Mapping[str, float] = field(default_factory=dict)
    start_cpu: float | None = None
    steps: int | None = None
    evaluations: int | None = None
    events: int | None = None

    @property
    def cost(self) -> float:
        """Median of the CPU times."""
        return median(self.cpu)


@dataclass(frozen=True)
class Omission:
    """A method, or a quantity of it, that is not among the rows, and the reason."""

    scene: str
    method: str
    quantity: str
    reason: str


@dataclass(frozen=True, repr=False)
class Trade(Shown, Tabular):
    """All measurements on one scene, of a run of `periods` drive periods, `simulated` s."""

    scene: str
    title: str
    friction_law: int
    periods: int
    simulated: float
    rows: tuple[Row, ...]
    omissions: tuple[Omission, ...]

    @property
    def heading(self) -> str:
        """Title, scene and friction law."""
        return f"{self.title} (scene {self.scene}, {LAWS[self.friction_law]} friction)"

    def table(self) -> dict[str, list[Any]]:
        """Return the rows in columns, as in the CSV file."""
        cells = [_cells(row) for row in self.rows]
        return {name: [row[i] for row in cells] for i, name in enumerate(COLUMNS)}

    def describe(self) -> list[str]:
        """Return the scene, the cheapest methods of each class at each target, and counts."""
        lines = [self.heading]
        for target, sentences in comparisons(self):
            lines += [f"  {target}", *(f"    {sentence}" for sentence in sentences)]
        omitted = number_of(len(self.omissions), "omission")
        return [*lines, f"  {number_of(len(self.rows), 'row')}, {omitted}"]

    def having(self, quantity: str) -> list[Row]:
        """Return the rows with an error of this quantity."""
        return [row for row in self.rows if quantity in row.errors]

    def candidates(self, quantity: str) -> list[Row]:
        """Return the rows under the friction law of the scene, of those with this error."""
        return [row for row in self.having(quantity) if row.friction_law == self.friction_law]


def front(rows: Iterable[Row], quantity: str) -> list[Row]:
    """Return the Pareto front: rows, by cost, that no other beats in both error and cost.

    Errors below 1e-12 count as equal: they are rounding over a thousand drive periods.
    """

    def error(row: Row) -> float:
        return max(row.errors[quantity], 1e-12)

    best: list[Row] = []
    for row in sorted(rows, key=lambda row: (row.cost, error(row))):
        if not best or error(row) < error(best[-1]):
            best.append(row)
    return best


def cheapest(rows: Iterable[Row], quantity: str, error: float) -> Row | None:
    """Return the cheapest row with an error of a quantity of at most `error`, None without any."""
    good = [row for row in rows if row.errors.get(quantity, float("inf")) <= error]
    return min(good, key=lambda row: row.cost, default=None)


COLUMNS = (
    *("scene", "answer", "kind", "family", "method", "fidelity", "averaging_order"),
    "friction_law",
    *("step_periods", "tolerance", "periods", "repeats", "cpu_median_s", "cpu_min_s", "cpu_max_s"),
    *("start_cpu_s", "steps", "evaluations", "events"),
    *(f"error_{quantity}" for quantity in QUANTITIES),
)
"""Columns of the data; CPU times are per simulated second where `answer` is `run`, else per answer;
what a method does not have or does not report is empty."""


def write_tables(rows: Path, omissions: Path, trades: Sequence[Trade]) -> None:
    """Write all rows, and the omissions with their reasons; HarnessError if that is impossible."""
    write_csv(rows, COLUMNS, (_cells(row) for trade in trades for row in trade.rows))
    lines = (vars(omission).values() for trade in trades for omission in trade.omissions)
    write_csv(omissions, ("scene", "method", "quantity", "reason"), lines)


def _cells(row: Row) -> list[Any]:
    return [
        *(row.scene, row.answer, row.kind, row.family, row.method),
        *(row.fidelity, row.averaging_order, row.friction_law),
        *(row.step, row.tolerance, row.periods, len(row.cpu), row.cost, min(row.cpu), max(row.cpu)),
        *(row.start_cpu, row.steps, row.evaluations, row.events),
        *(row.errors.get(quantity) for quantity in QUANTITIES),
    ]


TARGETS = (("mean_velocity", 1e-2), ("position", 1e-9))
"""Quantity, and the error at which costs are compared."""
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


def _sentence(standing: Standing) -> str:
    row, name = standing.row, CLASSES[standing.kind]
    if row is None:
        return f"{name}: not reached"
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
        by_target.setdefault(target, []).append(_sentence(one))
    return list(by_target.items())


def duration(seconds: float) -> str:
    """Return a CPU time in three digits, with a unit."""
    rounded = float(f"{seconds:.3g}")
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if rounded >= size:
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
CHOICE_COLUMNS = (
    *(*texts("need"), *numbers("within"), *texts("model")),
    *(*numbers("error", "native FMU", "Python FMU"), *texts("cheapest peer")),
)


def choices(trade: Trade) -> list[tuple[str, ...]]:
    """Return the cheapest method for every need of a scene, in the order of `CHOICE_COLUMNS`.

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
        table = Table(CHOICE_COLUMNS, choices(trade))
        if path.suffix == ".md":
            heading = markdown.escaped(trade.heading)
            parts.append(f"\n**{heading}**\n\n{markdown.rendered(table)}\n")
        else:
            heading = html_page.escaped(trade.heading)
            parts.append(f"<h3>{heading}</h3>\n{html_page.rendered(table)}")
    write_marked(path, "\n".join(parts), BEGIN, END)
