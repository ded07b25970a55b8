"""The whole matrix."""

from __future__ import annotations

from itertools import chain

from harness.extremes.cell import Cell
from harness.extremes.device_axes import device_cells
from harness.extremes.event_axes import event_cells
from harness.extremes.input_axes import input_cells
from harness.extremes.step_axes import step_cells


def all_cells(*, long: bool = False) -> list[Cell]:
    """Return every cell; `long` adds resolved runs of up to 1e8 periods, some minutes each."""
    return list(chain(device_cells(), input_cells(), step_cells(long=long), event_cells()))
