"""Coulomb friction with tanh(velocity / width) in place of sgn: smooth, stiff, and never at rest.

The common way to have no events at all. The narrower the width, the smaller the error and the
stiffer the equations; where friction should hold the slider, it creeps.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.scipy_methods import scipy_method
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.studies.trade.peers.event_free import EventFreeRun


def simulate(
    device: Device,
    held: Sequence[HeldInputs],
    times: NDArray[np.float64],
    *,
    width: float,
    method: str = "LSODA",
    rtol: float = 1e-9,
    atol: float = 1e-11,
) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    ``width`` is in m/s, ``method`` DOP853, LSODA or Radau, ``atol`` in fractions of a
    characteristic velocity and displacement. Counts and modes are those of ``EventFreeRun.run``,
    and so is what is raised, besides ValueError for a width that is not above 0 and for another
    method.
    """
    if not 0.0 < width < np.inf:
        raise ValueError(f"width = {width!r} m/s: must be a finite number above 0")
    return EventFreeRun(device, times, scipy_method(method), rtol, atol, width).run(held)
