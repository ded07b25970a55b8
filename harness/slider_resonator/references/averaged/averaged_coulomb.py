"""The averaged slow motion under Coulomb friction, at any integer ratio of the two frequencies.

Dimensionless as in `closed_forms`: velocities in units of ``x0 w0``, forces in units of the mean
friction ``faces mu N0``, time in ``1 / w0``. ``strength`` is q, ``amplitude_ratio`` alpha,
``ratio`` the frequency of the normal load over that of the drive, and ``phase`` the phase of the
normal load when the tangential force passes through zero upward. Functions on a device are
dimensional. The contact may lift (``amplitude_ratio`` > 1), except where a function says otherwise.
"""

from __future__ import annotations

import math

from slider_resonator.device.device import Device
from slider_resonator.references.averaged.vibrating_contact import (
    check_amplitude_ratio,
    closed_spans,
    mean_load,
    turning_angle,
    turns_until_repeat,
)
from slider_resonator.references.closed_forms import (
    EquivalentForce,
    check_never_lifts,
    check_strength,
    equivalent_force,
)
from slider_resonator.references.halving import root_by_halving


def mean_friction(
    velocity: float, strength: float, amplitude_ratio: float, phase: float, ratio: float = 1.0
) -> float:
    """Return the friction averaged over the fast motion, the bracket of (4) for any ratio.

    The fast velocity is ``velocity - strength cos(theta)``; at and beyond ``strength`` friction no
    longer changes sign. An integer ratio n gives
    ``1 - 2 theta / pi - 2 alpha / (n pi) sin(n theta) sin(phase)`` for a contact that never lifts;
    where the load never repeats (see `turns_until_repeat`) only its mean counts. Raises ValueError
    as `steady_velocity_at_ratio` does for strength and amplitude_ratio.
    """
    check_strength(strength)
    check_amplitude_ratio(amplitude_ratio)
    angle = turning_angle(velocity, strength)
    slide = 1.0 - 2.0 * angle / math.pi
    if ratio == 0.0:
        return slide * max(0.0, 1.0 + amplitude_ratio * math.sin(phase))
    turns = turns_until_repeat(amplitude_ratio, ratio)
    if turns == 0:
        return slide * mean_load(amplitude_ratio)
    if amplitude_ratio > 1.0:
        total = 0.0
        for turn in range(turns):
            begin = 2.0 * math.pi * turn
            there, back, again = begin - angle, begin + angle, begin + 2.0 * math.pi - angle
            total += _load_integral(back, again, amplitude_ratio, phase, ratio)
            total -= _load_integral(there, back, amplitude_ratio, phase, ratio)
        return total / (2.0 * math.pi * turns)
    share = 2.0 * amplitude_ratio / (ratio * math.pi)
    return slide - share * math.sin(ratio * angle) * math.sin(phase)


def slow_acceleration(
    velocity: float, strength: float, amplitude_ratio: float, phase: float
) -> float:
    """Return the acceleration of the slow motion, (4).

    With `drifting_phase` as the phase it is (A.2).
    """
    return -mean_friction(velocity, strength, amplitude_ratio, phase)


def linear_slow_acceleration(
    velocity: float, strength: float, amplitude_ratio: float, phase: float
) -> float:
    """Return the acceleration of the slow motion for velocities small against q, (6).

    With `drifting_phase` as the phase it is (A.3). Raises ValueError for a contact that lifts.
    """
    check_never_lifts(amplitude_ratio)
    return 2.0 / math.pi * (amplitude_ratio * math.sin(phase) - velocity / strength)


def drifting_phase(time: float, detuning: float, phase: float) -> float:
    """Return the phase in rad at a dimensionless time for frequencies that differ, psi of (A.1)."""
    return detuning * time + phase


def linear_beat_velocity(strength: float, amplitude_ratio: float, detuning: float) -> float:
    """Return the amplitude of the slow velocity that (A.3) settles to at a detuning.

    Raises ValueError for a contact that lifts.
    """
    check_never_lifts(amplitude_ratio)
    return 2.0 * amplitude_ratio / math.pi / math.hypot(detuning, 2.0 / (math.pi * strength))


def linear_beat_displacement(strength: float, amplitude_ratio: float, detuning: float) -> float:
    """Return the amplitude of the slow displacement that (A.3) settles to at a detuning.

    Raises ValueError for no detuning, as the slider then slides on, and for a contact that lifts.
    """
    if detuning == 0.0:
        raise ValueError("detuning = 0: the slider does not oscillate, it slides on")
    return linear_beat_velocity(strength, amplitude_ratio, detuning) / abs(detuning)


def steady_velocity_at_ratio(
    strength: float, amplitude_ratio: float, phase: float, ratio: float, load: float
) -> float:
    """Return the steady slow velocity at any ratio under a load, (20) for ratio 1.

    Raises ValueError unless ``strength`` > 0, ``amplitude_ratio`` is finite and at least 0, and the
    load is less than the mean friction of full sliding (1, more for a contact that lifts, at
    ratio 0 that of the load as it stands).
    """
    limit = mean_friction(strength, strength, amplitude_ratio, phase, ratio)
    if not -limit < load < limit:
        raise ValueError(
            f"load = {load!r} must lie between -{limit!r} and {limit!r}, the mean friction of full "
            "sliding: a greater load runs away"
        )

    def imbalance(angle: float) -> float:
        velocity = strength * math.cos(angle)
        return mean_friction(velocity, strength, amplitude_ratio, phase, ratio) + load

    # The later sliding turns forward, the less of the load, never negative, counts as friction.
    return strength * math.cos(root_by_halving(imbalance, 0.0, math.pi))


def blocking_load_at_ratio(amplitude_ratio: float, phase: float, ratio: float) -> float:
    """Return the load that stops the motion at any ratio, (21) for ratio 1.

    Raises ValueError for an amplitude_ratio that is negative or not finite.
    """
    return -mean_friction(0.0, 1.0, amplitude_ratio, phase, ratio)


def device_blocking_force_at_ratio(device: Device, phase: float, ratio: float) -> float:
    """Return the load in N that stops a device at any ratio, (22) for ratio 1; phase in rad.

    Raises ValueError as `equivalent_force` does.
    """
    lag = phase_to_force(equivalent_force(device), phase, ratio)
    return device.mean_friction * blocking_load_at_ratio(device.amplitude_ratio, lag, ratio)


def device_steady_velocity_at_ratio(
    device: Device, phase: float, ratio: float, load: float = 0.0
) -> float:
    """Return the steady velocity of a device in m/s at any ratio, phase in rad, load in N.

    Raises ValueError as `equivalent_force` and `steady_velocity_at_ratio` do.
    """
    force = equivalent_force(device)
    lag, share = phase_to_force(force, phase, ratio), load / device.mean_friction
    fast = force.velocity_amplitude
    return steady_velocity_at_ratio(fast, device.amplitude_ratio, lag, ratio, share)


def phase_to_force(force: EquivalentForce, phase: float, ratio: float) -> float:
    """Return the phase in rad relative to the equivalent force from that to the base excitation."""
    return phase + ratio * force.angle


def slow_start(device: Device) -> float:
    """Return the slow velocity in m/s of a device that starts from rest, resonator and all.

    The drive leaves the momentum ``m A w + tangential_force / w`` between its swings; a start with
    the resonator's steady motion, as (34) assumes, would leave another.
    """
    frequency = device.drive_frequency
    push = device.resonator_mass * device.base_amplitude * frequency
    return (push + device.tangential_force / frequency) / device.total_mass


def _load_integral(
    start: float, end: float, amplitude_ratio: float, phase: float, ratio: float
) -> float:
    """Return the integral of the load over theta; the contact may lift, the ratio is not 0."""
    return sum(
        (last - first)
        - amplitude_ratio
        / ratio
        * (math.cos(ratio * last + phase) - math.cos(ratio * first + phase))
        for first, last in closed_spans(start, end, amplitude_ratio, phase, ratio)
    )
