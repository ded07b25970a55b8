"""The paper's own method: DOP853 straight through the discontinuities of sgn, no events.

At every reversal the method loses its order and shrinks its steps until the jump fits the
tolerance; in a stick it chatters about zero velocity. It is here for comparison of cost and error.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.studies.trade.peers.event_free import MOST_EVALUATIONS, EventFreeRun


def simulate(
    device: Device,
    held: Sequence[HeldInputs],
    times: NDArray[np.float64],
    *,
    rtol: float = 1e-6,
    atol: float = 1e-10,
    most_evaluations: int = MOST_EVALUATIONS,
) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    Takes the inputs that ``located_events.simulate`` takes; ``atol`` is in fractions of a
    characteristic velocity and displacement, and the cost of stepping over a jump hangs on it.
    Without events there is no stick: counts and modes are those of ``EventFreeRun.run``, which
    says too what is raised; a chatter may take ``most_evaluations`` of the right hand side.
    """
    run = EventFreeRun(device, times, DOP853, rtol, atol, most_evaluations=most_evaluations)
    return run.run(held)
