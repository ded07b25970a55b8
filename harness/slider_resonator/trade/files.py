"""The data of trades as CSV: one file of rows, one of omissions."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from slider_resonator.output.atomic import write_csv
from slider_resonator.trade.result import Row, Trade
from slider_resonator.trade.solution import QUANTITIES

COLUMNS = (
    *("scene", "answer", "kind", "family", "method", "fidelity", "averaging_order"),
    "friction_law",
    *("step_periods", "tolerance", "periods", "repeats", "cpu_median_s", "cpu_min_s", "cpu_max_s"),
    *("start_cpu_s", "steps", "evaluations", "events"),
    *(f"error_{quantity}" for quantity in QUANTITIES),
)
"""Columns of the data; CPU times are per simulated second where `answer` is `run`, else per answer;
what a method does not have or does not report is empty."""


def write_rows(path: Path, trades: Sequence[Trade]) -> None:
    """Write all rows; HarnessError when that is impossible."""
    write_csv(path, COLUMNS, (_cells(row) for trade in trades for row in trade.rows))


def write_omissions(path: Path, trades: Sequence[Trade]) -> None:
    """Write the omissions with their reasons; HarnessError when that is impossible."""
    lines = [
        (omission.scene, omission.method, omission.quantity, omission.reason)
        for trade in trades
        for omission in trade.omissions
    ]
    write_csv(path, ("scene", "method", "quantity", "reason"), lines)


def _cells(row: Row) -> list[Any]:
    return [
        *(row.scene, row.answer, row.kind, row.family, row.method),
        *(row.fidelity, row.averaging_order, row.friction_law),
        *(row.step, row.tolerance, row.periods, len(row.cpu), row.cost, min(row.cpu), max(row.cpu)),
        *(row.start_cpu, row.steps, row.evaluations, row.events),
        *(row.errors.get(quantity) for quantity in QUANTITIES),
    ]
