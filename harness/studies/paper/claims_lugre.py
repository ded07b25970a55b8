"""Statements on the fundamental model with LuGre friction."""

from collections.abc import Iterator
from math import pi

import numpy as np

from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.uniform_average import LugreCase
from studies.paper import slow_theory
from studies.paper.claim import Claim, ClaimGroup, claim, labelled, near
from studies.paper.mapping import lugre_case, stiffness_of
from studies.paper.measure import blocking_force, steady_velocity

FREQUENCY = 1000.0
SOFT = 10.0
"""sigma_0 with kappa = 0.025 at q = 1 and mu = 0.4."""
STIFF = 1e4
"""sigma_0 with kappa = 25 at q = 1 and mu = 0.4."""
KAPPAS = (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)
OWN = 100.0
"""sigma_0 of the paper."""


def _velocity(instance: Instance, stiffness: float = OWN, **changes: float) -> float:
    return steady_velocity(instance, lugre_case(LugreCase(**changes), FREQUENCY, stiffness))


def _blocking(instance: Instance, stiffness: float, strength: float, friction: float) -> float:
    case = LugreCase(strength=strength, friction_coefficient=friction)
    return blocking_force(instance, lugre_case(case, FREQUENCY, stiffness))


def _shapes(instance: Instance) -> Iterator[Claim]:
    phases = (pi / 2.0 + 0.05 * np.arange(-12, 13)).tolist()
    best, soft = (
        max(phases, key=lambda phase: _velocity(instance, stiffness, phase=phase))
        for stiffness in (OWN, SOFT)
    )
    yield claim(
        "lugre_quadrature",
        abs(best - pi / 2.0) <= 0.15 and abs(soft - pi / 2.0) <= 0.01,
        {"best_phase_sigma_0_100": best, "best_phase_sigma_0_10": soft},
    )
    over_mu = {mu: _velocity(instance, friction_coefficient=mu) for mu in (0.1, 0.2, 0.4, 0.8)}
    falls = bool(np.all(np.diff(list(over_mu.values())) < 0.0))
    yield claim("lugre_falls_with_mu", falls, labelled("V_at_mu", over_mu))
    over_q = {q: _velocity(instance, strength=q) for q in (0.25, 0.5, 1.0, 2.0)}
    over_alpha = {a: _velocity(instance, amplitude_ratio=a) for a in (0.25, 0.5, 1.0)}
    yield claim(
        "lugre_grows",
        all(np.all(np.diff(list(over.values())) > 0.0) for over in (over_q, over_alpha)),
        labelled("V_at_q", over_q) | labelled("V_at_alpha", over_alpha),
    )
    linear = slow_theory.lugre_linear_velocity(LugreCase(amplitude_ratio=0.05))
    found = _velocity(instance, amplitude_ratio=0.05)
    yield claim("lugre_linear", near(found, linear, 0.06), {"formula": linear, "fmu": found})


def _manifold(instance: Instance) -> Iterator[Claim]:
    paper = slow_theory.lugre_steady_velocity(LugreCase())
    high, low = (
        steady_velocity(instance, lugre_case(LugreCase(), frequency, OWN))
        for frequency in (1000.0, 10.0)
    )
    numbers = {"formula": paper, "fmu": high, "kappa": 0.25}
    yield claim("slow_manifold_high_frequency", near(high, paper, 5e-3), numbers)
    uniform = slow_theory.uniform_velocity(LugreCase(), OWN, 10.0)
    yield claim(
        "slow_manifold_low_frequency",
        near(low, 0.6645, 5e-3) and not near(low, paper, 0.1),
        {"formula": paper, "fmu": low, "uniform": uniform, "kappa": 25.0},
    )


def _over_kappa(instance: Instance) -> Iterator[Claim]:
    numbers = {"formula": slow_theory.lugre_blocking_load(LugreCase())}
    worst = 0.0
    for kappa in KAPPAS:
        stiffness = stiffness_of(kappa, LugreCase(), FREQUENCY)
        direct = _blocking(instance, stiffness, 1.0, 0.4)
        uniform = slow_theory.uniform_blocking_load(LugreCase(), stiffness, FREQUENCY)
        numbers |= {f"fmu_kappa_{kappa:g}": direct, f"uniform_kappa_{kappa:g}": uniform}
        worst = max(worst, abs(direct - uniform))
    yield claim(
        "lugre_blocking_force",
        worst < 2e-3 and near(numbers["fmu_kappa_0.01"], numbers["formula"], 2e-3),
        {**numbers, "largest_difference_of_uniform": worst},
    )


def _what_blocks(instance: Instance) -> Iterator[Claim]:
    soft = {q: _blocking(instance, SOFT, q, 0.4) for q in (0.5, 1.0)}
    stiff = {q: _blocking(instance, STIFF, q, 0.4) for q in (0.5, 1.0)}
    heavy = {**lugre_case(LugreCase(), FREQUENCY, SOFT), "slider_mass": 2.0}
    soft_heavy = blocking_force(instance, heavy)
    yield claim(
        "lugre_blocking_depends_on_drive",
        near(soft[0.5], 0.25, 5e-3)
        and near(soft[1.0], 0.5, 5e-3)
        and near(soft_heavy, 0.25, 5e-3)
        and near(stiff[1.0], stiff[0.5], 0.05),
        {**labelled("soft_q", soft), "soft_q_1_mass_2": soft_heavy, **labelled("stiff_q", stiff)},
    )
    soft, stiff = (
        {0.4: at_one[1.0], 0.8: _blocking(instance, stiffness, 1.0, 0.8)}
        for at_one, stiffness in ((soft, SOFT), (stiff, STIFF))
    )
    yield claim(
        "lugre_blocking_without_mu",
        near(soft[0.8], soft[0.4], 5e-3) and near(stiff[0.8], 2.0 * stiff[0.4], 0.1),
        labelled("soft_mu", soft) | labelled("stiff_mu", stiff),
    )


GROUP = ClaimGroup(
    "claims_lugre", "LuGre friction", (_shapes, _manifold, _over_kappa, _what_blocks)
)
