"""Statements on the fundamental model with Coulomb friction."""

from __future__ import annotations

from math import pi

import numpy as np

from slider_resonator.checks.measures.ripple import ripple_amplitude
from slider_resonator.fmu.instance import Instance
from slider_resonator.references import closed_forms
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.studies.paper.claim import AGREES, DISAGREES, Claim, ClaimGroup, near
from slider_resonator.studies.paper.mapping import coulomb_case
from slider_resonator.studies.paper.measure import record, steady_velocity

FREQUENCY = 1000.0
HIGH_FREQUENCY = 10000.0
"""For small q: averages err by 1 / (q Omega)."""
PHASES = tuple(np.linspace(0.1, pi - 0.1, 15).tolist())
RIPPLE_FREQUENCIES = (10.0, 100.0, 1000.0)


def _phase(instance: Instance) -> list[Claim]:
    velocities = [steady_velocity(instance, coulomb_case(1.0, FREQUENCY, phase=p)) for p in PHASES]
    best = PHASES[int(np.argmax(velocities))]
    forward, backward = (
        steady_velocity(instance, coulomb_case(1.0, FREQUENCY, phase=p)) for p in (0.9, -0.9)
    )
    return [
        Claim(
            "quadrature",
            "2.3.1",
            "Coulomb: the velocity is largest when the excitations are in quadrature",
            {"best_phase_rad": best, "velocity_there": max(velocities)},
            AGREES,
            "the averaged drive is alpha sin(phi); phases were 0.1 to pi - 0.1 in 15 steps",
            near(best, pi / 2.0, 1e-6),
        ),
        Claim(
            "negative_phase",
            "2.3.1",
            "Coulomb: phases between -pi and 0 move the slider backward",
            {"velocity_at_0.9": forward, "velocity_at_-0.9": backward},
            AGREES,
            "(5) is odd in phi; the FMU as well up to order 1 / Omega",
            near(-backward, forward, 5e-3) and backward < 0.0 < forward,
        ),
    ]


def _strengths(instance: Instance) -> list[Claim]:
    per_q = [
        steady_velocity(instance, coulomb_case(q, HIGH_FREQUENCY, phase=0.5)) / q
        for q in (0.1, 1.0, 3.0)
    ]
    per_alpha = [
        steady_velocity(instance, coulomb_case(1.0, FREQUENCY, a)) / a for a in (0.1, 0.3, 1.0)
    ]
    theory = [closed_forms.steady_velocity(1.0, a, pi / 2.0) / a for a in (0.1, 0.3, 1.0)]
    return [
        Claim(
            "linear_in_q",
            "2.3.1",
            "Coulomb: for small q the velocity is proportional to q",
            {f"V/q_at_q_{q:g}": v for q, v in zip((0.1, 1.0, 3.0), per_q, strict=True)},
            AGREES,
            "and for any q: (5) contains only V / q; what is left is of order 1 / (q Omega)",
            max(per_q) - min(per_q) < 0.01 * max(per_q),
        ),
        Claim(
            "linear_in_alpha",
            "2.3.1",
            "Coulomb: for small alpha the velocity is proportional to alpha",
            {f"V/alpha_at_alpha_{a:g}": v for a, v in zip((0.1, 0.3, 1.0), per_alpha, strict=True)},
            AGREES,
            "(7) gives V / alpha = q sin(phi) = 1; (5), met by the FMU, lies 0.7 % below it at "
            "alpha = 0.1 and 33 % at alpha = 1",
            all(near(v, t, 2e-3) for v, t in zip(per_alpha, theory, strict=True)),
        ),
    ]


def _blocking(instance: Instance) -> list[Claim]:
    cases = {
        "q_0.5": coulomb_case(0.5, FREQUENCY),
        "q_1": coulomb_case(1.0, FREQUENCY),
        "q_2": coulomb_case(2.0, FREQUENCY),
        "mass_2": {**coulomb_case(2.0, FREQUENCY), "slider_mass": 2.0},
        "Omega_100": coulomb_case(1.0, 100.0),
    }
    forces = {
        name: find_blocking(instance, values).blocking_force or float("nan")
        for name, values in cases.items()
    }
    theory = closed_forms.blocking_load(1.0, pi / 2.0)
    return [
        Claim(
            "blocking_independent",
            "2.3.2",
            "Coulomb: the blocking force depends neither on the tangential drive nor on the mass",
            forces,
            AGREES,
            f"(21) gives {theory:.4f} mu N0 for all; the FMU differs by order 1 / (q Omega)",
            all(near(force, theory, 0.03) for force in forces.values()),
        ),
        Claim(
            "load_scale",
            "below (20)",
            "The load of (20) is made dimensionless with m x0 omega^2",
            {
                "fmu_blocking_over_m_x0_w0^2": forces["q_1"],
                "and_over_m_x0_w^2": forces["q_1"] / 1e6,
            },
            DISAGREES,
            "(21) holds with m x0 omega_0^2 = mu N0, the scale of all forces in (2): a slip",
            near(forces["q_1"], theory, 5e-3),
        ),
    ]


def _ripple(instance: Instance) -> list[Claim]:
    amplitudes = {}
    for frequency in RIPPLE_FREQUENCIES:
        period = 2.0 * pi / frequency
        run = record(instance, coulomb_case(1.0, frequency), 40 * period, 40 * 32)
        amplitude = ripple_amplitude(run.times, run["position"], period)
        amplitudes[f"ripple_times_Omega_at_{frequency:g}"] = amplitude * frequency
    return [
        Claim(
            "ripple_over_frequency",
            "2.3",
            "The fast oscillation has the amplitude q / Omega and falls with the frequency",
            amplitudes,
            AGREES,
            "q = 1: the product tends to 1; at Omega = 10 the impact of friction on it shows",
            near(amplitudes["ripple_times_Omega_at_1000"], 1.0, 5e-3)
            and near(amplitudes["ripple_times_Omega_at_100"], 1.0, 0.03),
        )
    ]


GROUP = ClaimGroup(
    "claims_coulomb",
    "Coulomb friction",
    (_phase, _strengths, _blocking, _ripple),
)
