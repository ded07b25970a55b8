"""A segment of motion in one contact mode: argument and result of an integrator."""

from collections.abc import Callable
from dataclasses import dataclass

from slider_resonator.arrays import Array
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.equations import Equations, State


@dataclass(frozen=True)
class Segment:
    """A contact mode, to be followed for at most ``span`` s.

    It obeys ``equations`` and begins ``start`` s into the run, under the inputs ``now`` and at the
    angles (rad) ``theta`` of the drive and ``angle`` of the normal load. The motion is sampled at
    ``samples`` (shape (n,), ascending, within (0, span], s from its start).
    """

    equations: Equations
    mode: int
    start: float
    state: State
    theta: float
    angle: float
    now: HeldInputs
    span: float
    samples: Array
    direction: int

    @property
    def largest_ratio(self) -> float:
        """The largest magnitude of the ratio within the span."""
        first = self.now.frequency_ratio
        return max(abs(first), abs(first + self.now.ratio_rate * self.span))


@dataclass(frozen=True)
class SegmentResult:
    """The motion until the first event of the mode, or through the whole span.

    ``event`` is 0 if the span ended without one. In a slip it is the sign of the acceleration at
    which the velocity vanished; in a stick the direction in which the slider breaks loose.
    ``samples`` has shape (k, 4), with LuGre friction (k, 5): the states at the sample times within
    ``duration`` s.
    """

    duration: float
    state: State
    event: int
    samples: Array
    steps: int
    evaluations: int


Follow = Callable[[Segment], SegmentResult]
"""An integrator: follows a segment of motion to the first event of its contact mode."""
