"""The device under held inputs: the coefficients of its equations of motion (26)-(27).

With theta the phase of the drive, chi = psi + phase that of the normal load, s the direction of
sliding (0 in flight) and Y the resonator relative to the slider:

    slip:   Y'' + 2 decay Y' + stiffness Y = relative_drive sin(theta) + (F + load) / M
            (M + m) X'' = Re(drive e) - F - load - m Y'',      F = s (F0 + F1 sin(chi))
    stick:  Y'' + 2 xi wn Y' + wn^2 Y = A w^2 sin(theta),      X' = 0

where e = -i exp(i theta). A held slider is one of infinite mass: the first two lines with 1 / M = 0
are the third. At fidelity 1 the resonator acts through its steady force (34) alone.
"""

from cmath import phase as argument
from cmath import rect
from cmath import sqrt as complex_sqrt
from dataclasses import dataclass
from functools import cached_property
from math import cos, pi, sqrt

from . import refusal_texts as texts
from .contact import NormalLoad
from .moment import Moment
from .parameters import Inputs, Parameters
from .values import Refusal

EPSILON = 2.0**-52
"""Spacing of floating point numbers above 1: the unit of rounding errors."""

APART = 0.87
"""Distance of the eigenvalues, over the undamped frequency, from which on they are well apart: at
damping ratios below 0.9 and above 1.1."""

DISTINCT = 1e-8
"""Half the distance of two equal eigenvalues, over each: what it changes is rounding, squared."""

SLOW = 0.02
"""Share of the drive frequency below which an oscillator or a forcing counts as slow, and relative
distance of forcing frequency and eigenvalue in resonance: there the steady response would be far
larger than the response between two reversals."""


@dataclass(frozen=True)
class Oscillator:
    """y'' + 2 `decay` y' + `stiffness` y = g(t), coefficients in 1/s and 1/s^2."""

    decay: float
    stiffness: float

    @property
    def frequency(self) -> float:
        """Undamped angular frequency [rad/s]."""
        return sqrt(self.stiffness)

    @cached_property
    def eigenvalues(self) -> tuple[complex, complex]:
        """Both eigenvalues [1/s]: conjugate with the upper one first, or the slow one first.

        Two that are equal count as `DISTINCT`: free motion is a sum of two exponentials.
        """
        root = complex_sqrt(self.decay * self.decay - self.stiffness) or DISTINCT * self.decay
        fast = -self.decay - root
        return (self.stiffness / fast if fast else 0j), fast

    def splits(self, *frequencies: float) -> bool:
        """Whether free motion and steady responses at `frequencies` [rad/s] lose few digits."""
        slow, fast = self.eigenvalues
        if self.frequency < SLOW * max(map(abs, frequencies)):
            return False
        resonant = (abs(slow - complex(0.0, abs(f))) < SLOW * abs(slow) for f in frequencies)
        return abs(slow - fast) > APART * self.frequency and not any(resonant)

    def transfer(self, frequency: float) -> complex:
        """Steady response to exp(i frequency t), as a complex amplitude [s^2]."""
        damping = 2.0 * self.decay * frequency
        return 1.0 / complex(self.stiffness - frequency * frequency, damping)

    def free(self, y: float, u: float) -> list[tuple[complex, complex]]:
        """Rates z and amplitudes a of free motion from `y` and `u` on: a sum of Re(a exp(z t))."""
        slow, fast = self.eigenvalues
        if slow.imag:
            return [(slow, complex(y, (slow.real * y - u) / slow.imag))]
        of_slow = (u - fast * y) / (slow - fast)
        return [(slow, of_slow), (fast, y - of_slow)]


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

    def oscillator(self, held: bool) -> Oscillator:
        """The resonator against a `held` slider, or a free one (eq. 31 divided by 1 - r_m)."""
        share, wn = 1.0 if held else self.slider_mass / self.total_mass, self.resonator_frequency
        return Oscillator(self.damping_ratio * wn / share, wn * wn / share)

    @property
    def full_friction(self) -> float:
        """Mean friction [N] of sliding in one direction, but for the shape of a clipped load."""
        normal = max(self.normal_preload, self.normal_amplitude / pi)
        return self.friction_faces * self.friction_coefficient * normal


class Vibration:
    """The steady vibration without friction or load, in closed form (31)-(34), with direct drive.

    Its `frequency` [rad/s], velocity amplitudes [m/s], `lag` theta_1 [rad], and complex amplitudes
    of e: of the `force` on slider and resonator together, F_T* exp(-i theta_1) [N], and of the
    `resonator` [m]. `velocity` is v_q of the slider, `pair_velocity` the one that the drive force
    gives to the pair, of which the resonator has the `mass_fraction`. On a `held` slider, of
    infinite mass, the force is that which must hold it.
    """

    def __init__(self, device: Device, held: bool = False) -> None:
        """Raises Refusal where undamped resonance leaves no steady vibration."""
        w, m, direct = device.drive_frequency, device.resonator_mass, device.tangential_force
        oscillator, square, damping = device.oscillator(held), w * w, device.damping_ratio
        # Within rounding of undamped resonance the steady force has no correct digit.
        if damping == 0.0 and abs(oscillator.stiffness - square) <= 8.0 * EPSILON * square:
            raise Refusal(texts.UNBOUNDED_RESONANCE, damping_ratio=damping, drive_frequency=w)
        base, inertia = device.base_amplitude * square, device.total_mass * w
        self.frequency, self.mass_fraction = w, device.mass_fraction
        relative = base if held else base - direct / device.slider_mass
        self.resonator = relative * oscillator.transfer(w)
        self.force = m * square * (device.base_amplitude + self.resonator) + direct
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


Term = tuple[complex, complex, complex]
"""Rate z [1/s] of an exponential, velocity v_z of the slider, displacement y_z of the resonator."""


@dataclass(frozen=True, slots=True)
class Mode:
    """The equations with a free slider, or with a held one: its mass is infinite.

    A force accelerates the slider by the `mobility` [1/kg] and the pair by the `pair_mobility`. The
    resonator, an `oscillator` against the slider, has the `mass_fraction` of the pair. A constant
    force displaces it by the `compliance` [m/N]. The steady `responses`, per unit exp(i theta) of
    the drive and, for s = 1, exp(i chi) of the normal load, are None where splitting the motion
    into these and free motion loses digits.
    """

    oscillator: Oscillator
    mobility: float
    pair_mobility: float
    mass_fraction: float
    compliance: float
    responses: tuple[Term, Term] | None


class System:
    """A device under held inputs (SI units; complex numbers are amplitudes of e).

    The full device (`is_full`) follows its resonator. Otherwise this vibrates in a `steady` way
    and acts by its steady force only, on a slider of the total mass: it has no mass itself, no
    `base_acceleration`, and no `coupling` to accelerations of the slider. The drive forces are the
    `direct` one on the slider and the `drive` on the pair [N]. `friction` is mu of all faces.
    `fastest` [rad/s] is the highest frequency, `arc` [s] the longest segment: after it a motion
    begins anew from its state. Neither depends on `phase` and `load`. The equations are those of a
    `free` and of a `held` slider.
    """

    def __init__(self, device: Device, inputs: Inputs) -> None:
        """Raises Refusal below fidelity 2 where the steady force of the resonator is unbounded."""
        w, self.is_full = device.drive_frequency, device.fidelity == 2
        self.device, self.inputs = device, inputs
        self.phase, self.load = inputs.phase, inputs.load
        self.drive_frequency, self.normal_frequency = w, inputs.frequency_ratio * w
        self.normal_load, self.total_mass = device.normal_load, device.total_mass
        self.friction = device.friction_faces * device.friction_coefficient
        self.friction_preload = self.friction * device.normal_preload
        self.friction_amplitude = self.friction * device.normal_amplitude
        self.slip, self.stick = device.oscillator(held=False), device.oscillator(held=True)
        self.fastest, self.coupling = max(w, abs(self.normal_frequency)), float(self.is_full)
        if self.is_full:
            self.slider_mass, m = device.slider_mass, device.resonator_mass
            self.direct, amplitude = complex(device.tangential_force), device.base_amplitude
            swinging = [o.frequency for o in (self.slip, self.stick) if o.decay < o.frequency]
            self.fastest = max([self.fastest, *swinging])
        else:
            self.slider_mass, m, self.steady = device.total_mass, 0.0, Vibration(device)
            self.direct, amplitude = self.steady.force, 0.0
        self.mass_fraction, self.base_acceleration = m / self.total_mass, amplitude * w * w
        self.spring, self.damper = m * self.stick.stiffness, 2.0 * m * self.stick.decay
        self.drive = m * self.base_acceleration + self.direct
        # Large arguments of sine and cosine have rounding errors.
        self.arc = 60.0 / self.fastest
        self.free, self.held = self._mode(held=False), self._mode(held=True)

    def _mode(self, held: bool) -> Mode:
        w, q = self.drive_frequency, 0.0 if held else self.normal_frequency
        oscillator = self.stick if held else self.slip
        mobility, pair_mobility, mass_fraction = 0.0, 0.0, 0.0
        if not held:
            mobility, pair_mobility = 1.0 / self.slider_mass, 1.0 / self.total_mass
            mass_fraction = self.mass_fraction
        by_slider = self.coupling * mobility

        def response(f: float, relative: complex, pair: complex) -> Term:
            """By accelerations of the resonator relative to the slider, and of the pair."""
            z, swing = complex(0.0, f), -1j * relative * oscillator.transfer(f) if relative else 0j
            return z, (-pair / f if f else 0j) - mass_fraction * z * swing, swing

        responses = None
        if not 0.0 < abs(q) < SLOW * w and (oscillator.splits(w, q) or not self.is_full):
            relative = self.base_acceleration - by_slider * self.direct
            friction = self.friction_amplitude
            responses = (
                response(w, relative, self.drive * pair_mobility),
                response(q, by_slider * friction, -friction * pair_mobility),
            )
        compliance = by_slider / oscillator.stiffness
        return Mode(oscillator, mobility, pair_mobility, mass_fraction, compliance, responses)

    def resonator(self, now: Moment) -> tuple[float, float]:
        """Displacement [m] and velocity [m/s] of the resonator: its own or the steady ones."""
        return (now.displacement, now.rate) if self.is_full else self.steady.swing(now.theta)

    def friction_limit(self, psi: float) -> float:
        """Friction force [N] of all faces at normal phase `psi` [rad] when sliding, 0 in flight."""
        return self.friction * self.normal_load.at(psi + self.phase)

    def is_lifted(self, psi: float) -> bool:
        """Whether the contact is lifted at normal phase `psi` [rad]."""
        return self.normal_load.is_lifted(psi + self.phase, self.normal_frequency)
