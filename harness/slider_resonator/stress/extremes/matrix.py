"""The whole matrix."""

from __future__ import annotations

from itertools import chain

from slider_resonator.stress.extremes.beat_axes import beat_cells
from slider_resonator.stress.extremes.cell import MatrixCell
from slider_resonator.stress.extremes.device_axes import device_cells
from slider_resonator.stress.extremes.event_axes import event_cells
from slider_resonator.stress.extremes.input_axes import input_cells
from slider_resonator.stress.extremes.step_axes import step_cells


def all_cells(*, long: bool = False) -> list[MatrixCell]:
    """Return every cell; `long` adds resolved runs of up to 1e8 periods, some minutes each."""
    steps = step_cells(long=long)
    return list(chain(device_cells(), input_cells(), beat_cells(), steps, event_cells()))
