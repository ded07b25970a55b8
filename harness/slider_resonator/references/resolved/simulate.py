"""The resolved motion of a device: the full equations with every event located, to rounding."""

from collections.abc import Sequence

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.mode_sequence import ModeSequence
from slider_resonator.references.resolved.segment_series import follow_series
from slider_resonator.references.resolved.trajectory import Trajectory


def simulate(device: Device, held: Sequence[HeldInputs], times: Array) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    ``times`` ascend within ``[held[0].start, held[-1].stop]``; theta and psi are 0 at the first
    start. A sample on a boundary between inputs belongs to the inputs before it. Counts cover the
    whole span of the inputs; ``evaluations`` counts Taylor series. Raises ValueError for a device
    that the equations do not cover and times outside the inputs; RuntimeError for a contact that
    cannot be resolved in floating point numbers, and for a motion that leaves these.
    """
    return ModeSequence(device, follow_series, times).run(held)
