"""The slow motion of second order: on the mean friction of held orbits.

With W = X' + r Y' + D / (Mt w) cos(theta), D = m A w^2 + f_t, exactly ``Mt W' = -F - load``. On the
held orbit W = V + w1, and the slow velocity V obeys ::

    Mt V' = -(1 + kappa_m) (F2(V, lead) + load)
    V(0) = W(0) - w1(theta(0), lead; V(0))

Near a ratio p/q the lead of the normal load drifts by (ratio - p/q) w. Changed inputs keep W: a
load changes nothing else, a phase changes w1 and with it V. The centre ``X + r Y + D / (Mt w^2)
sin(theta)`` has the rate W: it is the integral of V and of w1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import astuple, dataclass, field, replace

import numpy as np
from scipy.integrate import solve_ivp

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import (
    HeldInputs,
    check_contiguous,
    check_times,
    with_steady_phase,
)
from slider_resonator.references.averaged.averaged_motion import MAX_DETUNING
from slider_resonator.references.averaged.held_curve import HeldCurve
from slider_resonator.references.averaged.held_orbit import HeldOrbit
from slider_resonator.references.averaged.held_orbit_that_sticks import any_held_orbit
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.averaged.vibrating_contact import turns_until_repeat
from slider_resonator.references.phase import advanced
from slider_resonator.references.resolved.equations import State, initial_state

_LEADS = 9
"""Leads of the normal load, an odd number, between which F2 is interpolated in a drift."""

_LEAD_DIGITS = 12
"""Decimal places to which leads are equal: inputs that come back then find their curve."""

_MAX_STARTS = 60
_RELATIVE, _ABSOLUTE = 1e-12, 1e-14


@dataclass(frozen=True)
class SlowMotion:
    """Slow motion at ``time``: arrays of shape (n,), SI units.

    ``slow_velocity`` is V; all others include the fast motion of the held orbit.
    """

    time: Array
    position: Array
    velocity: Array
    resonator_displacement: Array
    resonator_velocity: Array
    slow_velocity: Array


def momentum_velocity(
    device: Device, velocity: Array, resonator_velocity: Array, theta: Array
) -> Array:
    """Return W in m/s of velocities in m/s at drive angles in rad."""
    carried = velocity + device.mass_ratio * resonator_velocity
    return np.asarray(carried + _push(device) / device.total_mass * np.cos(theta))


@dataclass(frozen=True)
class SlowStart:
    """Initial values of the slow motion: W in m/s, the centre in m, both angles in rad.

    ``theta`` is that of the drive, ``psi`` that of the normal load without the input phase.
    """

    momentum_velocity: float
    centre: float
    theta: float = 0.0
    psi: float = 0.0


def slow_start(device: Device, state: State, theta: float = 0.0, psi: float = 0.0) -> SlowStart:
    """Return the initial values of the slow motion at a state of the device, at angles in rad.

    The state is assumed to be on a held orbit: any other motion of the resonator is neglected.
    """
    position, velocity, displacement, swing = state
    share = device.mass_ratio
    way = _push(device) / (device.total_mass * device.drive_frequency)
    return SlowStart(
        momentum_velocity=float(
            momentum_velocity(device, np.array(velocity), np.array(swing), np.array(theta))
        ),
        centre=position + share * displacement + way * math.sin(theta),
        theta=theta,
        psi=psi,
    )


def simulate_slow_motion(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    start: SlowStart | None = None,
) -> SlowMotion:
    """Return the slow motion of second order under held inputs at ``times`` (shape (n,), s).

    ``times`` ascend within ``[held[0].start, held[-1].stop]``. The motion begins at ``start``, by
    default with the initial values of the device and theta = psi = 0. Phase and load may have
    rates. Raises ValueError for a ratio without slow phase, inputs with gaps, times outside them,
    and as `Hold` does; RuntimeError where there is no orbit.
    """
    check_contiguous(held, rates=("phase_rate", "load_rate"))
    check_times(times, held)
    curves = _Curves(device)
    start = start or slow_start(device, initial_state(replace(device, fidelity=2)))
    momentum, centre, theta, psi = astuple(start)
    rows = np.empty((0, 5))
    for inputs in with_steady_phase(held, device):
        last = np.searchsorted(times, inputs.stop, side="right")
        samples = times[len(rows) : last] - inputs.start
        grid = np.union1d(samples, [0.0, inputs.stop - inputs.start])
        slow = _Slow(curves, inputs, theta, psi)
        slow.begin(momentum, centre)
        moved, velocity = slow.run(grid)
        places = np.searchsorted(grid, samples)
        found = [
            slow.motion(float(grid[place]), float(moved[place]), float(velocity[place]))
            for place in places
        ]
        rows = np.vstack([rows, np.array(found).reshape(-1, 5)])
        momentum, centre = slow.end(float(grid[-1]), float(moved[-1]), float(velocity[-1]))
        turned = device.drive_frequency * float(grid[-1])
        theta, psi = advanced(theta, turned), advanced(psi, inputs.frequency_ratio * turned)
    return SlowMotion(times, *rows.T)


@dataclass
class _Curves:
    """The load-speed curves of a device at the leads that were asked for."""

    device: Device
    known: dict[tuple[float, float, int], HeldCurve] = field(default_factory=dict)

    def at(self, lead: float, ratio: float, turns: int) -> HeldCurve:
        lead = round(advanced(0.0, lead), _LEAD_DIGITS)
        key = (lead, ratio, turns)
        if key not in self.known:
            hold = Hold(self.device, 0.0, lead, ratio, turns)
            self.known[key] = HeldCurve(hold)
        return self.known[key]


class _Slow:
    """The slow motion under inputs that stay; time counts from when they were set."""

    def __init__(self, curves: _Curves, inputs: HeldInputs, theta: float, psi: float) -> None:
        device = curves.device
        ratio = inputs.frequency_ratio
        amplitude_ratio = device.normal_amplitude / device.normal_preload
        self._turns = turns_until_repeat(amplitude_ratio, ratio, MAX_DETUNING)
        if not self._turns:
            raise ValueError(f"frequency_ratio = {ratio!r}: the normal load has no slow phase")
        self._ratio = round(self._turns * ratio) / self._turns
        self._lead = inputs.phase + psi - self._ratio * theta
        self._drift = (ratio - self._ratio) * device.drive_frequency
        self._curves, self._inputs, self._theta = curves, inputs, theta
        self._velocity = self._centre = 0.0

    def begin(self, momentum: float, centre: float) -> None:
        """Take over W in m/s and the centre in m at time 0."""
        scale = self._curve(self._lead).hold.vibration.velocity_amplitude
        velocity = momentum
        for _ in range(_MAX_STARTS):
            excess, way, *_ = self._fast(0.0, velocity)
            before, velocity = velocity, momentum - excess
            if abs(velocity - before) <= 1e-13 * scale:
                self._velocity, self._centre = velocity, centre - way
                return
        raise RuntimeError(f"no slow velocity belongs to W = {momentum!r} m/s")

    def run(self, grid: Array) -> tuple[Array, Array]:
        """Return the integral of V in m and V in m/s at times in s from 0."""
        inputs, mass = self._inputs, self._curves.device.total_mass
        scale = self._curve(self._lead).hold.vibration.velocity_amplitude

        def slope(time: float, state: Array) -> tuple[float, float]:
            friction, factor = self._friction(time, float(state[1]))
            load = inputs.load + inputs.load_rate * time
            return float(state[1]), -factor * (friction + load) / mass

        solution = solve_ivp(
            slope,
            (0.0, grid[-1]),
            (0.0, self._velocity),
            method="DOP853",
            t_eval=grid,
            rtol=_RELATIVE,
            atol=_ABSOLUTE * scale,
        )
        if not solution.success:
            raise RuntimeError(f"the slow motion cannot be integrated: {solution.message}")
        return solution.y[0], solution.y[1]

    def motion(self, time: float, moved: float, velocity: float) -> tuple[float, ...]:
        """Return a row of `SlowMotion` without the time."""
        device = self._curves.device
        _, way, speed, displacement, swing = self._fast(time, velocity)
        swung = _push(device) / (device.total_mass * device.drive_frequency)
        position = self._centre + moved + way - device.mass_ratio * displacement
        position -= swung * math.sin(self._angle(time))
        return position, speed, displacement, swing, velocity

    def end(self, time: float, moved: float, velocity: float) -> tuple[float, float]:
        """Return W in m/s and the centre in m at a time."""
        excess, way, *_ = self._fast(time, velocity)
        return velocity + excess, self._centre + moved + way

    def _friction(self, time: float, velocity: float) -> tuple[float, float]:
        if not self._drift:
            return self._curve(self._lead).friction(velocity)
        count = _LEADS
        steps = 2.0 * math.pi * np.arange(count) / count
        past = self._lead + self._drift * time - steps
        orders = np.arange(1, count // 2 + 1)
        weights = (1.0 + 2.0 * np.cos(np.outer(past, orders)).sum(axis=1)) / count
        values = [self._curve(float(step)).friction(velocity) for step in steps]
        friction, factor = weights @ np.array(values)
        return float(friction), float(factor)

    def _fast(self, time: float, velocity: float) -> tuple[float, ...]:
        """Return w1 m/s, its integral m, X' m/s, Y m and Y' m/s of the orbit at a time and V."""
        orbit = self._orbit(time, velocity)
        theta = np.array([self._angle(time)])
        values = (
            orbit.momentum_excess,
            orbit.centre_excess,
            orbit.slider_velocity,
            orbit.resonator_displacement,
            orbit.resonator_velocity,
        )
        return tuple(float(orbit.panels.at(value, theta)[0]) for value in values)

    def _orbit(self, time: float, velocity: float) -> HeldOrbit:
        if not self._drift:
            return self._curve(self._lead).orbit(velocity)
        lead = self._lead + self._drift * time
        hold = Hold(self._curves.device, velocity, lead, self._ratio, self._turns)
        return any_held_orbit(hold)

    def _curve(self, lead: float) -> HeldCurve:
        return self._curves.at(lead, self._ratio, self._turns)

    def _angle(self, time: float) -> float:
        return self._theta + self._curves.device.drive_frequency * time


def _push(device: Device) -> float:
    """Return the amplitude of the momentum by the drive, D / w in N s."""
    push = device.resonator_mass * device.base_amplitude * device.drive_frequency
    return push + device.tangential_force / device.drive_frequency
