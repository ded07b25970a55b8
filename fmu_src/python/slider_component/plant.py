"""The equations of motion (26)-(27) under held inputs, as coefficients of their closed forms.

With theta the phase of the drive, chi = psi + phase that of the normal load, s the direction of
sliding (0 in flight) and Y the resonator relative to the slider:

    slip:   Y'' + 2 decay Y' + stiffness Y = relative_drive sin(theta) + (F + load) / M
            (M + m) X'' = (M + m) Re(drive e) - F - load - m Y'',      F = s (F0 + F1 sin(chi))
    stick:  Y'' + 2 xi wn Y' + wn^2 Y = A w^2 sin(theta),              X' = 0

where e = -i exp(i theta). At fidelity 1 the resonator acts through its steady force (34) alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf

from . import refusal_texts
from .device import Device, Inputs
from .motion import EPSILON
from .oscillator import Oscillator, transfer
from .refusal import Refusal

AT_RESONANCE = 8.0 * EPSILON
"""Relative difference of two squared frequencies that is due to rounding: without damping the
steady force has no correct digit there."""


@dataclass(frozen=True, slots=True)
class Plant:
    """Coefficients under held inputs (SI units; complex numbers are amplitudes of e).

    At fidelity 1 the resonator acts by its steady force only: `slider_mass` is the total mass,
    `mass_fraction`, `spring` and `damper` are 0, and `resonator_amplitude` is the steady
    displacement of the resonator [m], which is None at fidelity 2. `preload_share` is N0 / dN: the
    contact lifts below 1; -1 stands for no normal load at all. `holding_drive` is the part of the
    force on a held slider that follows the drive directly [N], `drive` the force of the drive on
    the pair per total mass [m/s^2].
    """

    slider_mass: float
    total_mass: float
    mass_fraction: float
    drive_frequency: float
    normal_frequency: float
    phase: float
    load: float
    friction_preload: float
    friction_amplitude: float
    preload_share: float
    slip: Oscillator
    stick: Oscillator
    drive: complex
    relative_drive: float
    base_acceleration: float
    holding_drive: complex
    spring: float
    damper: float
    resonator_amplitude: complex | None

    @property
    def resolves_resonator(self) -> bool:
        """Whether the motion of the resonator is followed: at fidelity 2."""
        return self.resonator_amplitude is None


def steady_resonator(device: Device) -> complex:
    """Steady displacement of the resonator, complex amplitude of e [m] (eqs 31-32).

    Friction and load are left out, a direct drive is kept. Raises Refusal where it is unbounded.
    """
    w = device.drive_frequency
    oscillator = slip_oscillator(device)
    detuning = abs(oscillator.stiffness - w * w)
    if device.damping_ratio == 0.0 and detuning <= AT_RESONANCE * w * w:
        raise Refusal(refusal_texts.unbounded_resonance(device.damping_ratio, w))
    return (
        device.base_amplitude * w * w - device.tangential_force / device.slider_mass
    ) * transfer(oscillator, w)


def held_amplitude(device: Device) -> float:
    """Amplitude of the steady force of resonator and direct drive on a held slider [N].

    Infinite where undamped resonance leaves no steady vibration.
    """
    w, wn = device.drive_frequency, device.resonator_frequency
    oscillator = Oscillator(device.damping_ratio * wn, wn * wn)
    detuning = abs(oscillator.stiffness - w * w)
    if device.damping_ratio == 0.0 and detuning <= AT_RESONANCE * w * w:
        return inf
    amplitude = device.base_amplitude * (1.0 + w * w * transfer(oscillator, w))
    force = device.resonator_mass * w * w * amplitude + device.tangential_force
    return hypot(force.real, force.imag)


def equivalent_force(device: Device) -> complex:
    """F_T* exp(-i theta_1) of eqs (33)-(34) with the direct drive added, in N."""
    w2 = device.drive_frequency * device.drive_frequency
    return (
        device.resonator_mass * w2 * (device.base_amplitude + steady_resonator(device))
        + device.tangential_force
    )


def plant(device: Device, inputs: Inputs) -> Plant:
    """Coefficients of the motion of `device` while `inputs` are held.

    Raises Refusal at fidelity 1 where the steady force of the resonator is unbounded.
    """
    w = device.drive_frequency
    normal_frequency = inputs.frequency_ratio * w
    m, total, wn = device.resonator_mass, device.total_mass, device.resonator_frequency
    faces_mu = device.friction_faces * device.friction_coefficient
    full = device.fidelity == 2
    base_acceleration = device.base_amplitude * w * w
    force = (
        complex(m * base_acceleration + device.tangential_force)
        if full
        else equivalent_force(device)
    )
    return Plant(
        slider_mass=device.slider_mass if full else total,
        total_mass=total,
        mass_fraction=device.mass_fraction if full else 0.0,
        drive_frequency=w,
        normal_frequency=normal_frequency,
        phase=inputs.phase,
        load=inputs.load,
        friction_preload=faces_mu * device.normal_preload,
        friction_amplitude=faces_mu * device.normal_amplitude,
        preload_share=_preload_share(device),
        slip=slip_oscillator(device),
        stick=Oscillator(device.damping_ratio * wn, wn * wn),
        drive=force / total,
        relative_drive=base_acceleration - device.tangential_force / device.slider_mass,
        base_acceleration=base_acceleration,
        holding_drive=complex(device.tangential_force) if full else force,
        spring=m * wn * wn if full else 0.0,
        damper=2.0 * device.damping_ratio * m * wn if full else 0.0,
        resonator_amplitude=None if full else steady_resonator(device),
    )


def _preload_share(device: Device) -> float:
    if device.normal_amplitude > 0.0:
        return device.normal_preload / device.normal_amplitude
    return inf if device.normal_preload > 0.0 else -1.0


def slip_oscillator(device: Device) -> Oscillator:
    """The resonator against a free slider (eq. 31 divided by 1 - r_m)."""
    free_share = device.slider_mass / device.total_mass
    wn = device.resonator_frequency
    return Oscillator(device.damping_ratio * wn / free_share, wn * wn / free_share)
