"""The Coulomb reference: heyoka's Taylor method, events located to rounding.

heyoka supplies the Taylor polynomials of the motion within one contact mode; the events are the
first roots of those polynomials.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.phase import Elapsed, advanced
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.mode_sequence import ModeSequence
from slider_resonator.references.resolved.polynomial_roots import first_fall
from slider_resonator.references.resolved.segment import Segment, SegmentResult
from slider_resonator.references.resolved.taylor_system import (
    DIRECTION,
    DRIVE_AND_NORMAL_ANGLE,
    HELD,
    LOAD_AND_RATIO_RATES,
    ROUNDING,
    ROUNDING_OF_A_SUM,
    held_parameters,
    rate_parameters,
    scales_of,
    series_values,
    taylor_integrator,
)
from slider_resonator.references.resolved.trajectory import Trajectory


def simulate(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    tolerance: float = ROUNDING,
) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    ``times`` ascend within ``[held[0].start, held[-1].stop]``; theta and psi are 0 at the first
    start. A sample on a boundary between inputs belongs to the inputs before it. ``tolerance``
    (scaled variables) leaves truncation errors only for studies of them. Counts cover the whole
    span of the inputs. ``evaluations`` counts Taylor expansions. Raises ValueError for a device
    that the equations do not cover, inputs with gaps, and times outside them; ModuleNotFoundError
    when heyoka is not installed.
    """

    def follow(segment: Segment) -> SegmentResult:
        integrator = taylor_integrator("coulomb", tolerance, rates=segment.varies)
        return _ScaledMotion(segment, integrator).follow()

    return ModeSequence(device, follow, times).run(held)


class _ScaledMotion:
    """One segment of motion in drive angle as time and forces over a characteristic force."""

    def __init__(self, segment: Segment, integrator: Any) -> None:
        self._equations = segment.equations
        self._segment = segment
        self._integrator = integrator
        self._force, self._scales = scales_of(segment.equations, segment.load)

    def follow(self) -> SegmentResult:
        segment, integrator = self._segment, self._integrator
        rate = self._equations.drive_frequency
        if segment.varies:
            integrator.pars[LOAD_AND_RATIO_RATES] = rate_parameters(
                self._equations, segment.load_rate, segment.ratio_rate, self._force
            )
        integrator.pars[DIRECTION] = segment.mode
        # The displacement counts from the start of the segment: a large position costs no digits.
        state = np.array([0.0, *segment.state[1:]]) / self._scales
        times = segment.samples * rate
        span = segment.span * rate
        longest = self._longest_step()
        elapsed = Elapsed()
        theta, angle = segment.theta, segment.angle
        load, ratio = segment.load, segment.frequency_ratio
        samples: list[Array] = []
        steps, event = 0, 0
        while not event and (remaining := elapsed.until(span)) > 0.0:
            integrator.pars[HELD] = held_parameters(
                self._equations, load, ratio, self._force, segment.mode
            )
            integrator.pars[DRIVE_AND_NORMAL_ANGLE] = theta, angle
            integrator.state[:] = state
            integrator.time = 0.0
            _, step = integrator.step(max_delta_t=min(remaining, longest), write_tc=True)
            coefficients = np.array(integrator.tc)
            steps += 1
            crossing = self._first_event(coefficients, (theta, angle), (load, ratio), step)
            if crossing is None:
                state = np.array(integrator.state)
            else:
                step, event = crossing
                state = series_values(np.array([step]), coefficients)[0]
            local = elapsed.until(times[len(samples) :])
            covered = local[: np.searchsorted(local, step, side="right")]
            samples.extend(series_values(covered, coefficients))
            elapsed.add(step)
            theta = advanced(theta, step)
            half = 0.5 * segment.ratio_rate / rate
            angle = advanced(angle, (ratio + half * step) * step)
            passed = (elapsed.seconds + elapsed.carry) / rate
            load = segment.load + segment.load_rate * passed
            ratio = segment.frequency_ratio + segment.ratio_rate * passed
        sampled = np.array(samples).reshape(-1, 4) * self._scales
        sampled[:, 0] += segment.state[0]
        displacement, velocity, resonator, resonator_velocity = (state * self._scales).tolist()
        return SegmentResult(
            duration=(elapsed.seconds + elapsed.carry) / rate if event else segment.span,
            state=(segment.state[0] + displacement, velocity, resonator, resonator_velocity),
            event=event,
            samples=sampled,
            steps=steps,
            evaluations=steps,
        )

    def _first_event(
        self,
        coefficients: Array,
        angles: tuple[float, float],
        inputs: tuple[float, float],
        step: float,
    ) -> tuple[float, int] | None:
        """Return scaled time and direction of the first event in a step, None if there is none.

        ``angles`` (rad) of drive and normal load, load (N) and ratio are those at its start.
        """
        mode = self._segment.mode
        if mode == LIFTED:
            return None
        noise = self._noise(coefficients, step)
        if mode != STICK:
            rest = first_fall(mode * coefficients[1], step, noise)
            return None if rest is None else (rest, -mode)
        limit, needed = self._stick_forces(coefficients, angles, inputs)
        found = [
            (crossing, event)
            for event in (1, -1)
            if (crossing := first_fall(limit - event * needed, step, noise)) is not None
        ]
        return min(found, default=None)

    def _longest_step(self) -> float:
        # heyoka sizes its steps by the motion. In a stick the event series hold sines that the
        # motion need not contain; steps of one radian of the faster keep them at rounding level.
        segment = self._segment
        return 1.0 / max(1.0, segment.largest_ratio) if segment.mode == STICK else np.inf

    def _noise(self, coefficients: Array, step: float) -> float:
        """Return the rounding error of forces and velocities in a step, over their scales.

        The resonator can push and pull with far more force than is left over on the slider.
        """
        equations = self._equations
        rate = equations.drive_frequency
        coupling = equations.coupling_damping + equations.coupling_stiffness / rate
        reach = np.abs(coefficients[2:] * step ** np.arange(coefficients.shape[1])).max()
        return ROUNDING_OF_A_SUM * float(1.0 + coupling / (equations.inertia * rate) * reach)

    def _stick_forces(
        self, coefficients: Array, angles: tuple[float, float], inputs: tuple[float, float]
    ) -> tuple[Array, Array]:
        """Return the Taylor coefficients of friction limit and needed force, over force scale."""
        equations, segment = self._equations, self._segment
        count = coefficients.shape[1]
        rate = equations.drive_frequency
        coupling = 1.0 / (equations.inertia * rate)
        load, ratio = inputs
        drive_sine, drive_cosine = _sine_series(angles[0], 1.0, count)
        normal_sine, _ = _sine_series(angles[1], ratio, count)
        if segment.ratio_rate:
            normal_sine = _chirp_series(angles[1], ratio, segment.ratio_rate / rate, count)
        needed = (
            coupling * equations.coupling_damping * coefficients[3]
            + coupling * equations.coupling_stiffness / rate * coefficients[2]
            + (equations.force_sine * drive_sine + equations.force_cosine * drive_cosine)
            / self._force
        )
        limit = equations.friction_amplitude / self._force * normal_sine
        needed[0] -= load / self._force
        needed[1] -= segment.load_rate / (rate * self._force)
        limit[0] += equations.friction_mean / self._force
        return limit, needed


def _sine_series(angle: float, rate: float, count: int) -> tuple[Array, Array]:
    """Return the Taylor coefficients of sin and cos of ``angle + rate t``, shape (count,) each."""
    sine, cosine = np.sin(angle), np.cos(angle)
    powers = np.concatenate([[1.0], np.cumprod(rate / np.arange(1.0, count))])
    order = np.arange(count) % 4
    return (
        np.array([sine, cosine, -sine, -cosine])[order] * powers,
        np.array([cosine, -sine, -cosine, sine])[order] * powers,
    )


def _chirp_series(angle: float, rate: float, chirp: float, count: int) -> Array:
    """Return the Taylor coefficients of sin(angle + rate t + chirp t^2 / 2), shape (count,)."""
    terms = np.zeros(count, dtype=np.complex128)
    terms[0] = np.exp(1j * angle)
    for order in range(count - 1):
        before = chirp * terms[order - 1] if order else 0.0
        terms[order + 1] = 1j * (rate * terms[order] + before) / (order + 1)
    return terms.imag
