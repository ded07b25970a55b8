"""The data of a trade: rows, omissions, the cheapest method at an error; and its CSV files."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import Any

from slider_resonator.output.files import write_csv
from slider_resonator.output.readable import number_of
from slider_resonator.output.shown import Shown, Tabular

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

    def table(self) -> dict[str, list[Any]]:
        """Return the rows in columns, as in the CSV file."""
        cells = [_cells(row) for row in self.rows]
        return {name: [row[i] for row in cells] for i, name in enumerate(COLUMNS)}

    def describe(self) -> list[str]:
        """Return the scene, and for each quantity the cheapest method within 1 %."""
        counts = f"{number_of(len(self.rows), 'row')}, {number_of(len(self.omissions), 'omission')}"
        lines = [f"{self.scene}: {number_of(self.periods, 'drive period')}, {counts}"]
        for quantity in QUANTITIES:
            row = cheapest(self.candidates(quantity), quantity, 1e-2)
            if row is not None:
                lines.append(f"{quantity} within 1 %: {row.method}, {row.cost:.3g} s of CPU time")
        return lines

    def having(self, quantity: str) -> list[Row]:
        """Return the rows with an error of this quantity."""
        return [row for row in self.rows if quantity in row.errors]

    def candidates(self, quantity: str) -> list[Row]:
        """Return the rows under the friction law of the scene, of those with this error."""
        return [row for row in self.having(quantity) if row.friction_law == self.friction_law]


FLOOR = 1e-16
"""Errors below this, the resolution of double precision, are drawn at it."""
ROUNDING = 1e-12
"""Errors below this are rounding over a thousand drive periods and compare as equal."""


def front(rows: Iterable[Row], quantity: str) -> list[Row]:
    """Return the Pareto front: rows, by cost, that no other beats in both error and cost.

    Errors below ROUNDING count as equal.
    """

    def error(row: Row) -> float:
        return max(row.errors[quantity], ROUNDING)

    best: list[Row] = []
    for row in sorted(rows, key=lambda row: (row.cost, error(row))):
        if not best or error(row) < error(best[-1]):
            best.append(row)
    return best


def drawn_error(row: Row, quantity: str) -> float:
    """Return the error of a quantity as it is drawn: not below FLOOR."""
    return max(row.errors[quantity], FLOOR)


def cost_label(rows: Sequence[Row]) -> str:
    """Return the label of the axis of costs: of answers, or of simulated seconds."""
    answers = bool(rows) and all(row.answer != "run" for row in rows)
    return f"CPU time per {'answer' if answers else 'simulated second'} [s]"


def cheapest(rows: Iterable[Row], quantity: str, error: float) -> Row | None:
    """Return the cheapest row with an error of a quantity of at most `error`, None without any."""
    good = [row for row in rows if row.errors.get(quantity, float("inf")) <= error]
    return min(good, key=lambda row: row.cost, default=None)


def families(rows: Sequence[Row]) -> list[str]:
    """Return the families in the order in which they appear."""
    return list(dict.fromkeys(row.family for row in rows))


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
