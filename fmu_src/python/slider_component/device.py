"""The device under held inputs: the coefficients of its equations of motion (26)-(27).

With theta the phase of the drive, chi = psi + phase that of the normal load, s the direction of
sliding (0 in flight) and Y the resonator relative to the slider:

    slip:   Y'' + 2 decay Y' + stiffness Y = relative_drive sin(theta) + (F + load) / M
            (M + m) X'' = (M + m) Re(drive e) - F - load - m Y'',      F = s (F0 + F1 sin(chi))
    stick:  Y'' + 2 xi wn Y' + wn^2 Y = A w^2 sin(theta),              X' = 0

where e = -i exp(i theta). At fidelity 1 the resonator acts through its steady force (34) alone.
"""

from cmath import phase as argument
from cmath import rect
from dataclasses import dataclass
from math import cos, inf, pi
from typing import NamedTuple

from . import refusal_texts
from .contact import NormalLoad
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
    def normal_load(self) -> NormalLoad:
        """The normal load of each face."""
        return NormalLoad(self.normal_preload, self.normal_amplitude)

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


class Vibration:
    """The steady vibration without friction or load, in closed form (31)-(34), with direct drive.

    Its `frequency` [rad/s], velocity amplitudes [m/s], `lag` theta_1 [rad], and complex amplitudes
    of e: of the `force` on slider and resonator together, F_T* exp(-i theta_1) [N], and of the
    `resonator` [m]. `velocity` is v_q of the slider, `pair_velocity` the one that the drive force
    gives to the pair, of which the resonator has the `mass_fraction`.
    """

    def __init__(self, device: Device) -> None:
        """Raises Refusal where undamped resonance leaves no steady vibration."""
        w, m, direct = device.drive_frequency, device.resonator_mass, device.tangential_force
        if _is_unbounded(device, device.slip_oscillator):
            shown = {"damping_ratio": device.damping_ratio, "drive_frequency": w}
            raise Refusal(refusal_texts.UNBOUNDED_RESONANCE, **shown)
        base, inertia = device.base_amplitude * w * w, device.total_mass * w
        self.frequency, self.mass_fraction = w, device.mass_fraction
        relative = base - direct / device.slider_mass
        self.resonator = relative * device.slip_oscillator.transfer(w)
        self.force = m * (w * w) * (device.base_amplitude + self.resonator) + direct
        self.velocity, self.lag = abs(self.force) / inertia, -argument(self.force)
        self.pair_velocity = (m * base + direct) / inertia

    def swing(self, theta: float) -> tuple[float, float]:
        """Displacement [m] and velocity [m/s] of the resonator at drive phase `theta` [rad]."""
        swung = self.resonator * rect(1.0, theta)
        return swung.imag, self.frequency * swung.real

    def ahead(self, theta: float, rate: float) -> float:
        """By how much the slow velocity V is above that of the slider [m/s].

        The resonator moves at `rate` [m/s]. V is the momentum of the pair over its mass, without
        what the drive force gives to it: V' is due to friction and load alone.
        """
        return self.mass_fraction * rate + self.pair_velocity * cos(theta)


def held_amplitude(device: Device) -> float:
    """Amplitude of the steady force of resonator and direct drive on a held slider [N]."""
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
    only: `slider_mass` is the total mass, `mass_fraction`, `spring`, `damper` and the `coupling` of
    accelerations to the resonator are 0, and it vibrates in a `steady` way. `direct` is the force
    of the drive on the slider [N], `drive` that on the pair per total mass [m/s^2]. The splits are
    None where splitting loses digits. `friction` is mu of all faces. `fastest` [rad/s] is the
    highest frequency, `arc` [s] the longest segment: after it a motion begins anew from its state.
    Neither depends on `phase` and `load`.
    """

    def __init__(self, device: Device, inputs: Inputs) -> None:
        """Raises Refusal at fidelity 1 where the steady force of the resonator is unbounded."""
        w, m, wn = device.drive_frequency, device.resonator_mass, device.resonator_frequency
        self.device, self.inputs = device, inputs
        self.phase, self.load = inputs.phase, inputs.load
        self.drive_frequency, self.normal_frequency = w, inputs.frequency_ratio * w
        self.normal_load = device.normal_load
        self.friction = device.friction_faces * device.friction_coefficient
        self.friction_preload = self.friction * device.normal_preload
        self.friction_amplitude = self.friction * device.normal_amplitude
        self.total_mass, self.base_acceleration = device.total_mass, device.base_amplitude * w * w
        self.slip, self.stick = device.slip_oscillator, device.stick_oscillator
        self.fastest = max(w, abs(self.normal_frequency))
        self.is_full = device.fidelity == 2
        self.coupling = float(self.is_full)
        if self.is_full:
            self.slider_mass, self.mass_fraction = device.slider_mass, device.mass_fraction
            self.spring, self.damper = m * wn * wn, 2.0 * device.damping_ratio * m * wn
            self.direct = complex(device.tangential_force)
            swinging = [o.frequency for o in (self.slip, self.stick) if o.decay < o.frequency]
            self.fastest = max([self.fastest, *swinging])
        else:
            self.slider_mass, self.mass_fraction = device.total_mass, 0.0
            self.spring = self.damper = 0.0
            self.steady = Vibration(device)
            self.direct = self.steady.force
        self.drive = (self.coupling * m * self.base_acceleration + self.direct) / device.total_mass
        self.arc = LONGEST_ARC / self.fastest
        self.slide_split, self.rest_split = self._slide_split(), self._rest_split()

    def _slide_split(self) -> Split | None:
        w, q, slip, coupling = self.drive_frequency, self.normal_frequency, self.slip, self.coupling
        if 0.0 < abs(q) < SLOW * w or (self.is_full and not slip.splits(w, q)):
            return None
        friction = self.friction_amplitude
        base = coupling * (self.base_acceleration - self.direct / self.slider_mass)
        drive = self._term(w, slip, base, self.drive)
        by_friction = coupling * friction / self.slider_mass
        normal = self._term(q, slip, by_friction, -friction / self.total_mass)
        compliance = coupling / (slip.stiffness * self.slider_mass)
        return Split(drive, normal, slip, self.mass_fraction, compliance)

    def _rest_split(self) -> Split | None:
        w, stick = self.drive_frequency, self.stick
        if self.is_full and not stick.splits(w):
            return None
        z, _, swing = self._term(w, stick, self.coupling * self.base_acceleration, 0.0)
        return Split((z, 0j, swing), (0j, 0j, 0j), stick, 0.0, 0.0)

    def _term(self, f: float, oscillator: Oscillator, relative: complex, pair: complex) -> Term:
        """Steady motion at `f` [rad/s].

        By accelerations of the resonator relative to the slider, and of the pair.
        """
        z, swing = complex(0.0, f), -1j * relative * oscillator.transfer(f) if relative else 0j
        return z, (-pair / f if f else 0j) - self.mass_fraction * z * swing, swing

    def friction_limit(self, psi: float) -> float:
        """Friction force [N] of all faces at normal phase `psi` [rad] when sliding, 0 in flight."""
        return self.friction * self.normal_load.at(psi + self.phase)

    def is_lifted(self, psi: float) -> bool:
        """Whether the contact is lifted at normal phase `psi` [rad]."""
        return self.normal_load.is_lifted(psi + self.phase, self.normal_frequency)
