"""The device under held inputs: the coefficients of its equations of motion (26)-(27).

With theta the phase of the drive, chi = psi + phase that of the normal load, s the direction of
sliding (0 in flight) and Y the resonator relative to the slider:

    slip:   Y'' + 2 decay Y' + stiffness Y = relative_drive sin(theta) + (F + load) / M
            (M + m) X'' = (M + m) Re(drive e) - F - load - m Y'',      F = s (F0 + F1 sin(chi))
    stick:  Y'' + 2 xi wn Y' + wn^2 Y = A w^2 sin(theta),              X' = 0

where e = -i exp(i theta). At fidelity 1 the resonator acts through its steady force (34) alone.
"""

from cmath import phase as argument
from dataclasses import dataclass
from math import asin, cos, inf, pi, sin, tau
from typing import NamedTuple

from . import refusal_texts
from .contact import Window
from .oscillator import SLOW, Oscillator
from .parameters import Inputs, Parameters
from .values import Refusal

EPSILON = 2.0**-52
"""Spacing of floating point numbers above 1: the unit of rounding errors."""

AT_RESONANCE = 8.0 * EPSILON
"""Relative difference of two squared frequencies that is due to rounding: without damping the
steady force has no correct digit there."""

LONGEST_ARC = 60.0
"""The longest segment, as an angle [rad] of the fastest oscillation: avoids the rounding errors of
large arguments of sine and cosine."""


@dataclass(frozen=True, slots=True)
class Device(Parameters):
    """All parameters (SI units); the defaults are the start values: table 1."""

    @property
    def total_mass(self) -> float:
        """Mass of slider and resonator [kg]."""
        return self.slider_mass + self.resonator_mass

    @property
    def mass_fraction(self) -> float:
        """Resonator mass over total mass, r_m (below eq. 29)."""
        return self.resonator_mass / self.total_mass

    @property
    def lifts(self) -> bool:
        """Whether the contact lifts at times."""
        return self.normal_amplitude > self.normal_preload

    @property
    def slip_oscillator(self) -> Oscillator:
        """The resonator against a free slider (eq. 31 divided by 1 - r_m)."""
        share, wn = self.slider_mass / self.total_mass, self.resonator_frequency
        return Oscillator(self.damping_ratio * wn / share, wn * wn / share)

    @property
    def stick_oscillator(self) -> Oscillator:
        """The resonator against a held slider."""
        wn = self.resonator_frequency
        return Oscillator(self.damping_ratio * wn, wn * wn)


class Vibration(NamedTuple):
    """The steady vibration without friction or load, in closed form (31)-(34), with direct drive.

    Its `frequency` [rad/s], velocity amplitudes [m/s], `lag` theta_1 [rad], and complex amplitudes
    of e: of the `force` on slider and resonator together, F_T* exp(-i theta_1) [N], and of the
    `resonator` [m]. `velocity` is v_q of the slider, `pair_velocity` the one that the drive force
    gives to the pair, of which the resonator has the `mass_fraction`.
    """

    frequency: float
    velocity: float
    pair_velocity: float
    lag: float
    force: complex
    resonator: complex
    mass_fraction: float

    def swing(self, theta: float) -> tuple[float, float]:
        """Displacement [m] and velocity [m/s] of the resonator at drive phase `theta` [rad]."""
        real, imag, sine, cosine = self.resonator.real, self.resonator.imag, sin(theta), cos(theta)
        return real * sine + imag * cosine, self.frequency * (real * cosine - imag * sine)

    def ahead(self, theta: float, rate: float) -> float:
        """By how much the slow velocity V is above that of the slider [m/s].

        The resonator moves at `rate` [m/s]. V is the momentum of the pair over its mass, without
        what the drive force gives to it: V' is due to friction and load alone.
        """
        return self.mass_fraction * rate + self.pair_velocity * cos(theta)


def vibration(device: Device) -> Vibration:
    """Raises Refusal where undamped resonance leaves no steady vibration."""
    w, m, direct = device.drive_frequency, device.resonator_mass, device.tangential_force
    if _is_unbounded(device, device.slip_oscillator):
        shown = {"damping_ratio": device.damping_ratio, "drive_frequency": w}
        raise Refusal(refusal_texts.UNBOUNDED_RESONANCE, **shown)
    base = device.base_amplitude * w * w - direct / device.slider_mass
    resonator = base * device.slip_oscillator.transfer(w)
    force = m * (w * w) * (device.base_amplitude + resonator) + direct
    inertia = device.total_mass * w
    pair = m * device.base_amplitude * w * w + direct
    velocities, lag = (abs(force) / inertia, pair / inertia), -argument(force)
    return Vibration(w, *velocities, lag, force, resonator, device.mass_fraction)


def held_amplitude(device: Device) -> float:
    """Amplitude of the steady force of resonator and direct drive on a held slider [N].

    Infinite where undamped resonance leaves no steady vibration.
    """
    w, oscillator = device.drive_frequency, device.stick_oscillator
    if _is_unbounded(device, oscillator):
        return inf
    amplitude = device.base_amplitude * (1.0 + w * w * oscillator.transfer(w))
    return abs(device.resonator_mass * w * w * amplitude + device.tangential_force)


def _is_unbounded(device: Device, oscillator: Oscillator) -> bool:
    square = device.drive_frequency * device.drive_frequency
    near = abs(oscillator.stiffness - square) <= AT_RESONANCE * square
    return near and device.damping_ratio == 0.0


def full_friction(device: Device) -> float:
    """Mean friction [N] of sliding in one direction, but for the shape of a clipped load."""
    normal = max(device.normal_preload, device.normal_amplitude / pi)
    return device.friction_faces * device.friction_coefficient * normal


Term = tuple[complex, complex, complex]
"""Rate z [1/s] of an exponential, velocity v_z of the slider, displacement y_z of the resonator."""


class Split(NamedTuple):
    """Motion in a contact mode, split into forced terms and the free motion of an `oscillator`.

    The terms are per unit exp(i theta) and, for s = 1, per unit exp(i chi). `compliance` is the
    displacement of the resonator by a constant force [m/N]; in free motion the slider moves by
    -`mass_fraction` times what the resonator does.
    """

    drive: Term
    normal: Term
    oscillator: Oscillator
    mass_fraction: float
    compliance: float


class System:
    """A device under held inputs (SI units; complex numbers are amplitudes of e).

    The full device (`is_full`) follows its resonator. At fidelity 1 this acts by its steady force
    only: `slider_mass` is the total mass, `mass_fraction`, `spring` and `damper` are 0, and
    it vibrates in a `steady` way. `holding_drive` is the part of the force
    on a held slider that follows the drive directly [N], `drive` the force of the drive on the pair
    per total mass [m/s^2]. `slide_split` and `rest_split` are None where splitting loses digits.
    The contact lifts at times, or always, in the `window` of chi, which it enters and leaves where
    it `switches`. `fastest` [rad/s] is the highest frequency, `arc` [s] the longest segment: after
    it a motion begins anew from its state. Neither depends on `phase` and `load`.
    """

    def __init__(self, device: Device, inputs: Inputs) -> None:
        """Raises Refusal at fidelity 1 where the steady force of the resonator is unbounded."""
        w, m, wn = device.drive_frequency, device.resonator_mass, device.resonator_frequency
        faces_mu = device.friction_faces * device.friction_coefficient
        self.device, self.inputs = device, inputs
        self.phase, self.load = inputs.phase, inputs.load
        self.drive_frequency, self.normal_frequency = w, inputs.frequency_ratio * w
        self.friction_preload = faces_mu * device.normal_preload
        self.friction_amplitude = faces_mu * device.normal_amplitude
        self.window = flight_window(device)
        self.switches = device.lifts and self.normal_frequency != 0.0
        self.total_mass, self.base_acceleration = device.total_mass, device.base_amplitude * w * w
        self.slip, self.stick = device.slip_oscillator, device.stick_oscillator
        self.is_full = device.fidelity == 2
        self.fastest = max(w, abs(self.normal_frequency))
        if self.is_full:
            self.slider_mass, self.mass_fraction = device.slider_mass, device.mass_fraction
            self.spring, self.damper = m * wn * wn, 2.0 * device.damping_ratio * m * wn
            self.holding_drive = complex(device.tangential_force)
            force = m * self.base_acceleration + self.holding_drive
            swinging = [o.frequency for o in (self.slip, self.stick) if o.is_oscillatory]
            self.fastest = max([self.fastest, *swinging])
        else:
            self.slider_mass, self.mass_fraction = device.total_mass, 0.0
            self.spring = self.damper = 0.0
            self.steady = vibration(device)
            force = self.holding_drive = self.steady.force
        self.drive, self.arc = force / device.total_mass, LONGEST_ARC / self.fastest
        self.slide_split, self.rest_split = self._slide_split(), self._rest_split()

    def _slide_split(self) -> Split | None:
        w, q, slip = self.drive_frequency, self.normal_frequency, self.slip
        if 0.0 < abs(q) < SLOW * w or (self.is_full and not slip.splits(w, q)):
            return None
        swing = swing_by_friction = 0j
        if self.is_full:
            base = self.base_acceleration - self.device.tangential_force / self.slider_mass
            swing = base * slip.transfer(w)
            swing_by_friction = self.friction_amplitude / self.slider_mass * slip.transfer(q)
        pushed = self.drive + self.mass_fraction * w * w * swing
        by_friction = self.mass_fraction * q * q * swing_by_friction
        by_friction -= self.friction_amplitude / self.total_mass
        slowed = -by_friction / q if q else 0j
        return Split(
            (complex(0.0, w), -pushed / w, -1j * swing),
            (complex(0.0, q), slowed, -1j * swing_by_friction),
            slip,
            self.mass_fraction,
            1.0 / (slip.stiffness * self.slider_mass) if self.is_full else 0.0,
        )

    def _rest_split(self) -> Split | None:
        w, stick, swing = self.drive_frequency, self.stick, 0j
        if self.is_full:
            if not stick.splits(w):
                return None
            swing = self.base_acceleration * stick.transfer(w)
        return Split((complex(0.0, w), 0j, -1j * swing), (0j, 0j, 0j), stick, 0.0, 0.0)

    def friction_limit(self, psi: float) -> float:
        """Friction force [N] of all faces at normal phase `psi` [rad] when sliding, 0 in flight."""
        limit = self.friction_preload + self.friction_amplitude * sin(psi + self.phase)
        return limit if limit > 0.0 else 0.0

    def is_lifted(self, psi: float) -> bool:
        """Whether the contact is lifted at normal phase `psi` [rad]."""
        return self.window.is_lifted(psi + self.phase, self.normal_frequency)


def flight_window(device: Device) -> Window:
    """The range of chi in which the contact of `device` is lifted."""
    if device.normal_preload == device.normal_amplitude == 0.0:
        return Window(0.0, tau)
    if not device.lifts:
        return Window(0.0, 0.0)
    dip = asin(device.normal_preload / device.normal_amplitude)
    return Window(pi + dip, tau - dip)
