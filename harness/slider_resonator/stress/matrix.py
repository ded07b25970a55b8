"""The whole matrix."""

from __future__ import annotations

from itertools import chain

from slider_resonator.stress.beat_axes import beat_cells
from slider_resonator.stress.case import MatrixCell
from slider_resonator.stress.device_axes import device_cells
from slider_resonator.stress.event_axes import event_cells
from slider_resonator.stress.input_axes import input_cells
from slider_resonator.stress.step_axes import step_cells


def all_cells(*, long: bool = False) -> list[MatrixCell]:
    """Return every cell; `long` adds resolved runs of up to 1e8 periods, some minutes each."""
    steps = step_cells(long=long)
    return list(chain(device_cells(), input_cells(), beat_cells(), steps, event_cells()))
