"""The averaged motion of a device, dimensional, for both friction laws.

The slow velocity V obeys ``total_mass V' = -friction - load``, friction being the mean over the
fast motion of the slider with velocity ``V - v_q cos(theta - theta1)``. Near an integer n the
frequency ratio lets the phase of the normal load drift slowly, by (ratio - n) w, which is appendix
A of the paper for every n; a clipped load does so near fractions too; elsewhere the mean load
counts. The fast motion is the steady vibration of (32)-(34), the normal load the instantaneous one.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise

import numpy as np
import scipy

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, with_steady_phase
from slider_resonator.references.averaged.device_average import (
    fast_motion,
    full_friction,
    mean_friction,
)
from slider_resonator.references.averaged.vibrating_contact import MAX_TURNS, turns_until_repeat
from slider_resonator.references.equivalent_force import EquivalentForce
from slider_resonator.references.phase import advanced
from slider_resonator.references.resolved.contact import LIFTED

MAX_DETUNING = 0.1
"""Largest distance of the frequency ratio from an integer at which the phase counts as slow. For a
load that repeats after several turns: of turns times the ratio, times the turns."""


@dataclass(frozen=True)
class AveragedMotion:
    """Averaged motion at ``time``: arrays of shape (n,), SI units.

    ``mean_velocity`` is the slow velocity; ``position`` and ``velocity`` carry the fast motion.
    ``contact_mode`` is 2 in flight, else the sign of the velocity. ``frictions`` give the friction
    at each sample.
    """

    time: Array
    frictions: Sequence[Callable[[], float]]
    position: Array
    velocity: Array
    mean_velocity: Array
    resonator_displacement: Array
    resonator_velocity: Array
    normal_force: Array
    contact_mode: Array

    @cached_property
    def friction_force(self) -> Array:
        """The mean friction of all faces over the fast motion at the present slow velocity."""
        return np.array([friction() for friction in self.frictions])


def simulate_averaged(device: Device, held: Sequence[HeldInputs], times: Array) -> AveragedMotion:
    """Return the averaged motion under held inputs at ``times`` (s), as `simulate` takes them.

    All inputs may have rates, load and ratio only under vibration. The initial values determine the
    momentum and the centre of mass of slider and resonator; directly after the start the fast
    motion is the steady vibration, whatever they are. Without vibration the motion is that of a
    block under dry friction. Where a run tunes the drive, momentum and centre are continuous; the
    slow velocity jumps with the drive's part of them.

    Raises ValueError as `fast_motion` does, RuntimeError when the slow motion cannot be integrated.
    """
    share = device.mass_ratio
    tuned = device.tuned(held[0].tuned)
    slow = device.initial_velocity + share * device.initial_resonator_velocity + slow_start(tuned)
    centre = device.initial_position + share * device.initial_resonator_displacement
    theta = psi = 0.0
    rows = np.empty((0, 7))
    frictions: list[Callable[[], float]] = []
    last = np.array([device.initial_position, device.initial_velocity])
    for inputs in in_slow_phases(with_steady_phase(held, device), device):
        before, tuned = tuned, device.tuned(inputs.tuned)
        drive, drive_before = slow_start(tuned), slow_start(before)
        slow += (drive - drive_before) * math.cos(theta)
        swing = drive / tuned.drive_frequency - drive_before / before.drive_frequency
        centre += swing * math.sin(theta)
        force = fast_motion(tuned)
        local = times[len(rows) : np.searchsorted(times, inputs.stop, side="right")] - inputs.start
        grid = np.union1d(local, [0.0, inputs.stop - inputs.start])
        moved, velocity = _slow_motion(tuned, force, inputs, (theta, psi), slow, grid)
        places = np.searchsorted(grid, local)
        angle = theta + tuned.drive_frequency * grid - force.angle
        position = centre + moved - force.ripple_amplitude * np.sin(angle)
        motion = np.column_stack([position, velocity - force.velocity_amplitude * np.cos(angle)])
        there, slow_there = motion[places], velocity[places]
        there[local <= np.spacing(inputs.start)] = last
        last = motion[-1]
        angle = theta + tuned.drive_frequency * local
        ratios = inputs.frequency_ratio + inputs.ratio_rate * local
        turned = 0.5 * (inputs.frequency_ratio + ratios) * tuned.drive_frequency * local
        load_angle = psi + inputs.phase + turned
        normal = tuned.normal_preload + tuned.normal_amplitude * np.sin(load_angle)
        swing = force.resonator_amplitude * np.exp(1j * (angle - force.resonator_angle))
        here = [
            *(there, slow_there, swing.imag, tuned.drive_frequency * swing.real),
            np.maximum(0.0, normal),
            np.where(normal > 0.0, np.sign(there[:, 1]), float(LIFTED)),
        ]
        rows = np.vstack([rows, np.column_stack(here)])
        sampled = np.column_stack([angle, load_angle, ratios, slow_there]).tolist()
        frictions += [partial(_friction, tuned, force, inputs.load, one) for one in sampled]
        centre += float(moved[-1])
        slow = float(velocity[-1])
        theta = advanced(theta, tuned.drive_frequency * float(grid[-1]))
        psi = advanced(psi, inputs.turned(float(grid[-1]), tuned.drive_frequency))
    return AveragedMotion(times, frictions, *rows.T)


def _friction(
    device: Device, force: EquivalentForce, load: float, sample: Sequence[float]
) -> float:
    """Return the mean friction (N) under a load (N) at a sample of the motion.

    It has the angles (rad) of drive and normal load, the frequency ratio, the slow velocity (m/s).
    """
    angle, load_angle, ratio, slow = sample
    if force.velocity_amplitude == 0.0:
        full = full_friction(device, load_angle, ratio)
        return float(np.clip(-load, -full, full) if slow == 0.0 else np.sign(slow) * full)
    _, near = slow_ratio(device, ratio)
    return mean_friction(device, force, slow, load_angle - near * angle, near)


def slow_start(device: Device) -> float:
    """Return the slow velocity in m/s of a device that starts from rest, resonator and all.

    The drive leaves the momentum ``m A w + tangential_force / w`` between its swings; a start with
    the resonator's steady motion, as (34) assumes, would leave another.
    """
    frequency = device.drive_frequency
    push = device.resonator_mass * device.base_amplitude * frequency
    return (push + device.tangential_force / frequency) / device.total_mass


def _slow_motion(
    device: Device,
    force: EquivalentForce,
    inputs: HeldInputs,
    angles: tuple[float, float],
    velocity: float,
    times: Array,
) -> tuple[Array, Array]:
    """Return slow displacement (m) and velocity (m/s) at ``times`` (s) since the inputs were set.

    ``velocity`` (m/s) is that at time 0; ``angles`` (rad) are theta and psi there.
    """
    theta, psi = angles
    fast = force.velocity_amplitude
    if fast == 0.0:
        for name in ("load_rate", "ratio_rate"):
            if rate := getattr(inputs, name):
                raise ValueError(f"{name} = {rate!r}: must be 0 for a device without vibration")
        friction = full_friction(device, inputs.phase + psi, inputs.frequency_ratio)
        return slide_of_block(velocity, friction, inputs.load, device.total_mass, times)
    span, frequency = inputs.stop - inputs.start, device.drive_frequency
    turns, ratio = slow_ratio(device, inputs.frequency_ratio + 0.5 * inputs.ratio_rate * span)
    lead = inputs.phase + psi - ratio * theta
    momentum = device.total_mass * fast

    def acceleration(time: float, share: float) -> float:
        """Return the rate of V; V is in units of the fast velocity."""
        ahead = inputs.turned(time, frequency) - ratio * frequency * time
        friction = mean_friction(device, force, fast * share, lead + ahead, ratio)
        return -(friction + inputs.load + inputs.load_rate * time) / momentum

    ends = (inputs.frequency_ratio, inputs.later(span).frequency_ratio)
    drift = max(abs(end - ratio) for end in ends) * frequency * max(turns, 1)
    max_step = 2.0 * math.pi / (32 * drift) if drift else math.inf
    if inputs.load_rate:
        max_step = min(max_step, _passage(device, inputs, fast) / 8)
    moved, slow = slow_trajectory(acceleration, times, velocity / fast, max_step)
    return fast * moved, fast * slow


def _passage(device: Device, inputs: HeldInputs, fast: float) -> float:
    """Return the shortest time (s) in which V passes the velocities at which the slider reverses.

    Beyond them friction is constant, and an integrator would step across them. Infinite under a
    load that never exceeds the preload's friction: it takes V to no edge.
    """
    span = inputs.stop - inputs.start
    load = max(abs(inputs.load), abs(inputs.load + inputs.load_rate * span))
    per_normal = device.friction_faces * device.friction_coefficient
    if load <= per_normal * device.normal_preload:
        return math.inf
    friction = per_normal * (device.normal_preload + device.normal_amplitude)
    return 2.0 * fast * device.total_mass / (load + friction)


def slow_ratio(device: Device, ratio: float) -> tuple[int, float]:
    """Return after how many turns the load nearly repeats, and the ratio at which it does.

    These are 0 and the ratio itself where the phase of the load is not slow.
    """
    turns = turns_until_repeat(device.amplitude_ratio, ratio, MAX_DETUNING)
    return turns, round(turns * ratio) / turns if turns else ratio


def in_slow_phases(held: Sequence[HeldInputs], device: Device) -> list[HeldInputs]:
    """Return the same inputs cut where a ratio that grows comes near a slow phase or leaves one."""
    parts: list[HeldInputs] = []
    for inputs in held:
        times: list[float] = []
        if inputs.ratio_rate:
            first = inputs.frequency_ratio
            low, high = sorted((first, first + inputs.ratio_rate * (inputs.stop - inputs.start)))
            lifts = device.tuned(inputs.tuned).amplitude_ratio > 1.0
            edges = {
                (whole + side * MAX_DETUNING / turns) / turns
                for turns in range(1, (MAX_TURNS if lifts else 1) + 1)
                for whole in range(math.floor(turns * low) - 1, math.ceil(turns * high) + 2)
                for side in (-1.0, 1.0)
            }
            reached = (inputs.start + (edge - first) / inputs.ratio_rate for edge in edges)
            times = sorted(time for time in reached if inputs.start < time < inputs.stop)
        for begin, end in pairwise([inputs.start, *times, inputs.stop]):
            parts.append(replace(inputs.later(begin - inputs.start), start=begin, stop=end))
    return parts


def slow_trajectory(
    acceleration: Callable[[float, float], float],
    times: Array,
    velocity: float = 0.0,
    max_step: float = np.inf,
) -> tuple[Array, Array]:
    """Return slow position and velocity at ``times`` (n,), from position 0 at the first of them.

    ``acceleration`` is a function of time and velocity; where it depends on time, steps of at most
    ``max_step`` resolve it. Raises RuntimeError when it cannot be integrated.
    """

    def rates(time: float, state: Array) -> tuple[float, float]:
        slow = float(state[1])  # scalars of numpy take several times as long
        return slow, acceleration(float(time), slow)

    solution = scipy.integrate.solve_ivp(
        rates,
        (times[0], times[-1]),
        (0.0, velocity),
        method="DOP853" if np.isfinite(max_step) else "LSODA",
        t_eval=times,
        rtol=1e-11,
        atol=1e-12,
        max_step=max_step,
    )
    if not solution.success:
        raise RuntimeError(f"the slow motion cannot be integrated: {solution.message}")
    return np.asarray(solution.y[0]), np.asarray(solution.y[1])


def slide_of_block(
    velocity: float, friction: float, load: float, mass: float, times: Array
) -> tuple[Array, Array]:
    """Return how far a block has moved (m) and its velocity (m/s) at ``times``, shape (n,), s.

    Dry friction of constant size acts against a constant load. ``velocity`` (m/s) is that at time
    0; ``friction`` (N) holds a block at rest against a smaller ``load`` (N), which pulls backward;
    ``mass`` is in kg.
    """
    deceleration = (math.copysign(friction, velocity) + load) / mass if velocity else 0.0
    stops = math.inf if velocity else 0.0
    if deceleration * velocity > 0.0:
        stops = velocity / deceleration
    first = np.minimum(times, stops)
    moved = velocity * first - 0.5 * deceleration * first**2
    speed = np.where(times < stops, velocity - deceleration * first, 0.0)
    if abs(load) > friction:
        dragged = -math.copysign(abs(load) - friction, load) / mass
        rest = np.maximum(times - stops, 0.0)
        moved += 0.5 * dragged * rest**2
        speed += dragged * rest
    return moved, speed
