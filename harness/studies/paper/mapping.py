"""The paper's dimensionless cases as parameters of the dimensional FMU.

The FMU is given masses and loads of 1 so that x0 = 1 m and w0 = 1 rad/s: its metres, seconds and
newtons are then the paper's dimensionless units, and results need no conversion.

- (2), Coulomb: one face, m = 1, mu = 1, N0 = 1, hence x0 = mu N0 / (m w0^2) = 1; one degree of
  freedom, on which F_T acts directly.
- (9), LuGre: one face, m = 1, N0 = 1, hence x0 = N0 / (m w0^2) = 1, sigma_0 and sigma_1 as given;
  mu is the paper's own.
- (28)-(29), device with resonator: two faces, M + m = 1, mu = 1/2, N0 = 1, hence
  x0 = 2 mu N0 / ((M + m) w0^2) = 1.
"""

from math import pi

from slider_resonator.references.averaged.uniform_average import LugreCase

Values = dict[str, float]
"""Parameters and inputs of the FMU by name."""


def coulomb_case(
    strength: float, frequency: float, amplitude_ratio: float = 1.0, phase: float = pi / 2.0
) -> Values:
    """Return the FMU values of (2) for q = F_T / Omega, Omega, alpha and phi in rad."""
    return {
        "fidelity": 1,
        "friction_faces": 1,
        "slider_mass": 1.0,
        "resonator_mass": 0.0,
        "base_amplitude": 0.0,
        "normal_preload": 1.0,
        "normal_amplitude": amplitude_ratio,
        "friction_coefficient": 1.0,
        "tangential_force": strength * frequency,
        "drive_frequency": frequency,
        "phase": phase,
    }


def stiffness_of(kappa: float, case: LugreCase, frequency: float) -> float:
    """Return sigma_0 of an averaged case for kappa = sigma_0 q / (mu Omega)."""
    return kappa * case.friction_coefficient * frequency / case.strength


def lugre_case(case: LugreCase, frequency: float, stiffness: float) -> Values:
    """Return the FMU values of (9) for an averaged case at Omega and sigma_0."""
    return {
        **coulomb_case(case.strength, frequency, case.amplitude_ratio, case.phase),
        "friction_coefficient": case.friction_coefficient,
        "friction_law": 1,
        "bristle_stiffness": stiffness,
        "bristle_damping": case.damping,
    }


def resonator_case(
    mass_ratio: float,
    resonator_frequency: float,
    frequency: float,
    base_amplitude: float,
    *,
    amplitude_ratio: float,
    phase: float,
    damping_ratio: float,
) -> Values:
    """Return the FMU values of (28)-(29) for r_m, Omega_n, Omega, a, alpha, phi_1 and xi."""
    return {
        "friction_faces": 2,
        "slider_mass": 1.0 - mass_ratio,
        "resonator_mass": mass_ratio,
        "resonator_frequency": resonator_frequency,
        "damping_ratio": damping_ratio,
        "base_amplitude": base_amplitude,
        "normal_preload": 1.0,
        "normal_amplitude": amplitude_ratio,
        "friction_coefficient": 0.5,
        "drive_frequency": frequency,
        "phase": phase,
    }
