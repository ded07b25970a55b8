"""The order of contact modes: which segment of motion follows which, and with what state.

Bristles never stick: the modes of LuGre friction are the directions of the motion, and flight.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, turning_apart, with_steady_phase
from slider_resonator.references.phase import Elapsed, advanced
from slider_resonator.references.resolved.contact import (
    LIFTED,
    SLIP_BACKWARD,
    SLIP_FORWARD,
    STICK,
    is_lifted,
    time_to_contact_change,
)
from slider_resonator.references.resolved.equations import (
    Equations,
    State,
    equations_of,
    initial_state,
)
from slider_resonator.references.resolved.trajectory import Recorder, Trajectory


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

_MAX_EVENTS_AT_ONE_INSTANT = 20


class ModeSequence:
    """Follows the motion through held inputs, from theta = psi = 0 at the first start."""

    def __init__(self, device: Device, follow: Follow, times: Array) -> None:
        self.state = initial_state(device)
        self._device = device
        self._equations = equations_of(device)
        self._follow = follow
        self._recorder = Recorder(times)
        self._theta = 0.0
        self._psi = 0.0
        self._events_at_this_instant = 0
        self._bends = device.friction_law == 1
        self._direction = -1 if self.state[1] < 0.0 else 1

    def run(self, held: Sequence[HeldInputs]) -> Trajectory:
        """Return the motion through the inputs, as `simulate` does."""
        for inputs in turning_apart(with_steady_phase(held, self._device)):
            self._equations = equations_of(self._device.tuned(inputs.tuned))
            self._run_held(inputs)
        return self._recorder.trajectory()

    def _run_held(self, inputs: HeldInputs) -> None:
        elapsed = Elapsed()
        span = inputs.stop - inputs.start
        mode = self._mode_now(inputs)
        self._keep_present(mode, inputs, self._recorder.pending(inputs.start))
        began = inputs.start
        if not self._bends:
            self._recorder.enter(mode, began)
        now = inputs
        while (remaining := elapsed.until(span)) > 0.0:
            chirp = now.ratio_rate * self._equations.drive_frequency
            contact_span = time_to_contact_change(mode == LIFTED, *self._load(now), chirp)
            result = self._pass(mode, now, min(remaining, contact_span), elapsed, inputs)
            if self._bends and result.duration:
                # Of a start at rest the first instant only shows the direction.
                self._recorder.enter(mode, began)
            frequency = self._equations.drive_frequency
            elapsed.add(result.duration)
            self._theta = advanced(self._theta, frequency * result.duration)
            self._psi = advanced(self._psi, now.turned(result.duration, frequency))
            self.state = result.state
            began = inputs.start + elapsed.seconds
            now = inputs.later(elapsed.total) if inputs.vary else inputs
            self._guard_progress(result.duration, began)
            if result.event:
                mode = self._mode_after_event(mode, result.event, now)
            elif contact_span < remaining:
                mode = self._mode_in_contact(now) if mode == LIFTED else LIFTED
            else:
                break
            if not self._bends:
                self._recorder.enter(mode, began)
        # An event at the stop, to rounding, has passed over the samples there.
        end = inputs.later(span)
        self._keep_present(mode, end, self._recorder.pending(inputs.stop))

    def _pass(
        self, mode: int, now: HeldInputs, span: float, elapsed: Elapsed, inputs: HeldInputs
    ) -> SegmentResult:
        """Follow a mode; ``now`` are the inputs as they are at present."""
        local = elapsed.until(self._recorder.pending(inputs.stop) - inputs.start)
        samples = local[: np.searchsorted(local, span, side="right")]
        segment = Segment(
            equations=self._equations,
            mode=mode,
            start=inputs.start + elapsed.seconds,
            state=self.state,
            theta=self._theta,
            angle=self._psi + now.phase,
            now=now,
            span=span,
            samples=samples,
            direction=self._direction if self._bends else mode,
        )
        result = self._follow(segment)
        if len(result.samples):
            self._keep(mode, now, samples[: len(result.samples)], result.samples)
        self._recorder.steps += result.steps
        self._recorder.evaluations += result.evaluations
        return result

    def _keep(self, mode: int, inputs: HeldInputs, local: Array, states: Array) -> None:
        equations = self._equations
        theta = self._theta + equations.drive_frequency * local
        angle = self._psi + inputs.phase + inputs.turned(local, equations.drive_frequency)
        resonator = equations.resonator_motion(theta, states)
        load = inputs.load + inputs.load_rate * local
        forces = equations.contact_forces(mode, load, theta, angle, states)
        modes = np.sign(states[:, 1]) if self._bends and mode != LIFTED else mode
        self._recorder.keep(states, resonator, forces, modes)

    def _keep_present(self, mode: int, inputs: HeldInputs, times: Array) -> None:
        """Keep the present state as the sample of each of the times."""
        count = len(times)
        self._keep(mode, inputs, np.zeros(count), np.tile(self.state, (count, 1)))

    def _load(self, inputs: HeldInputs) -> tuple[float, float, float, float]:
        """Return preload and amplitude (N) of the normal load, its angle (rad) and rate (rad/s)."""
        equations = self._equations
        rate = inputs.frequency_ratio * equations.drive_frequency
        angle = self._psi + inputs.phase
        return equations.normal_preload, equations.normal_amplitude, angle, rate

    def _mode_now(self, inputs: HeldInputs) -> int:
        return LIFTED if is_lifted(*self._load(inputs)) else self._mode_in_contact(inputs)

    def _mode_in_contact(self, inputs: HeldInputs) -> int:
        if self._bends:
            return self._direction
        _, velocity, displacement, resonator_velocity = self.state
        needed = self._equations.needed_force(
            inputs.load, self._theta, displacement, resonator_velocity
        )
        limit = self._equations.friction_limit(self._psi + inputs.phase)
        if not velocity and abs(needed) <= max(0.0, limit):
            return STICK
        return SLIP_FORWARD if (velocity or needed) > 0.0 else SLIP_BACKWARD

    def _mode_after_event(self, mode: int, event: int, inputs: HeldInputs) -> int:
        position, _, *others = self.state
        self.state = (position, 0.0, *others)
        if self._bends:
            self._direction = event
            return mode if mode == LIFTED else event
        now = self._mode_now(inputs)
        if mode == STICK and now != LIFTED:
            return SLIP_FORWARD if event > 0 else SLIP_BACKWARD
        return now

    def _guard_progress(self, duration: float, time: float) -> None:
        is_here = duration <= math.ulp(1.0) / self._equations.drive_frequency
        self._events_at_this_instant = self._events_at_this_instant + 1 if is_here else 0
        if self._events_at_this_instant > _MAX_EVENTS_AT_ONE_INSTANT:
            raise RuntimeError(
                f"contact at t = {time!r} s changes mode more than {_MAX_EVENTS_AT_ONE_INSTANT} "
                f"times at one instant (state {self.state!r}): stick and slip cannot be "
                "distinguished there; perturb the initial state or an input"
            )
