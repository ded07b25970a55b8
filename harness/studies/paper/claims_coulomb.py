"""Statements on the fundamental model with Coulomb friction."""

from collections.abc import Iterator
from math import pi

import numpy as np

from slider_resonator.checks.measures import ripple_amplitude
from slider_resonator.fmu.instance import Instance
from studies.paper import slow_theory
from studies.paper.claim import Claim, ClaimGroup, claim, labelled, near
from studies.paper.mapping import coulomb_case
from studies.paper.measure import blocking_force, record, steady_velocity

FREQUENCY = 1000.0
HIGH_FREQUENCY = 10000.0
"""For small q: averages err by 1 / (q Omega)."""
PHASES = tuple(np.linspace(0.1, pi - 0.1, 15).tolist())
RIPPLE_FREQUENCIES = (10.0, 100.0, 1000.0)


def _phase(instance: Instance) -> Iterator[Claim]:
    def velocity(phase: float) -> float:
        return steady_velocity(instance, coulomb_case(1.0, FREQUENCY, phase=phase))

    velocities = {phase: velocity(phase) for phase in PHASES}
    best = max(PHASES, key=velocities.__getitem__)
    numbers = {"best_phase_rad": best, "velocity_there": velocities[best]}
    yield claim("quadrature", near(best, pi / 2.0, 1e-6), numbers)
    forward, backward = velocity(0.9), velocity(-0.9)
    yield claim(
        "negative_phase",
        near(-backward, forward, 5e-3) and backward < 0.0 < forward,
        {"velocity_at_0.9": forward, "velocity_at_-0.9": backward},
    )


def _strengths(instance: Instance) -> Iterator[Claim]:
    per_q = {
        q: steady_velocity(instance, coulomb_case(q, HIGH_FREQUENCY, phase=0.5)) / q
        for q in (0.1, 1.0, 3.0)
    }
    spread = max(per_q.values()) - min(per_q.values())
    linear = spread < 0.01 * max(per_q.values())
    yield claim("linear_in_q", linear, labelled("V/q_at_q", per_q))
    per_alpha = {
        a: steady_velocity(instance, coulomb_case(1.0, FREQUENCY, a)) / a for a in (0.1, 0.3, 1.0)
    }
    theory = {a: slow_theory.steady_velocity(1.0, a, pi / 2.0) / a for a in per_alpha}
    yield claim(
        "linear_in_alpha",
        all(near(per_alpha[a], theory[a], 2e-3) for a in theory),
        labelled("V/alpha_at_alpha", per_alpha),
    )


def _blocking(instance: Instance) -> Iterator[Claim]:
    cases = {
        "q_0.5": coulomb_case(0.5, FREQUENCY),
        "q_1": coulomb_case(1.0, FREQUENCY),
        "q_2": coulomb_case(2.0, FREQUENCY),
        "mass_2": {**coulomb_case(2.0, FREQUENCY), "slider_mass": 2.0},
        "Omega_100": coulomb_case(1.0, 100.0),
    }
    forces = {name: blocking_force(instance, values) for name, values in cases.items()}
    theory = slow_theory.blocking_load(1.0, pi / 2.0)
    independent = all(near(force, theory, 0.03) for force in forces.values())
    yield claim("blocking_independent", independent, forces)
    one = forces["q_1"]
    yield claim(
        "load_scale",
        near(one, theory, 5e-3),
        {"fmu_blocking_over_m_x0_w0^2": one, "and_over_m_x0_w^2": one / 1e6},
    )


def _ripple(instance: Instance) -> Iterator[Claim]:
    product = {}
    for frequency in RIPPLE_FREQUENCIES:
        period = 2.0 * pi / frequency
        run = record(instance, coulomb_case(1.0, frequency), 40 * period, 40 * 32)
        product[frequency] = ripple_amplitude(run.times, run["position"], period) * frequency
    yield claim(
        "ripple_over_frequency",
        near(product[1000.0], 1.0, 5e-3) and near(product[100.0], 1.0, 0.03),
        labelled("ripple_times_Omega_at", product),
    )


GROUP = ClaimGroup("claims_coulomb", "Coulomb friction", (_phase, _strengths, _blocking, _ripple))
