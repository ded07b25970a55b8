"""The mean power of friction over a drive period, against the balance of energy.

Scenes compare it with force times velocity of the references.
"""

import math
from itertools import pairwise

import numpy as np
import pytest

from tests.fmu.host import Instance, Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

TURN = 2.0 * math.pi / 3500.0
BEGIN = 5
"""Drive periods before the one that is balanced."""

PIECES = 8
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)

CASES: dict[str, dict[str, float]] = {
    "table 1": {},
    "third multiple": {"frequency_ratio": 3.0, "phase": 1.0},
    "normal load that creeps": {"frequency_ratio": 0.01, "phase": 0.5},
    "with flight": {"normal_amplitude": 1.8, "phase": 0.4},
    "stick and slip": {"friction_coefficient": 4.0, "base_amplitude": 2e-5},
    "resonance without damping": {"damping_ratio": 0.0, "resonator_frequency": 3337.0},
    "overdamped, under a load": {"damping_ratio": 1.3, "load": 0.05},
    "direct drive": {"tangential_force": 200.0, "amplitude_deviation": 0.2},
    "hard bristles": {"friction_law": 1, "bristle_stiffness": 1e6},
    "soft bristles": {"friction_law": 1, "bristle_stiffness": 1e3},
    "bristles, flight": {"friction_law": 1, "normal_amplitude": 1.5, "frequency_ratio": 0.5},
}
TOLERANCE = 1e-8


def energy(instance: Instance) -> float:
    """Energy of slider and resonator [J]."""
    velocity, swing, displacement, mass, small, frequency = instance.get(
        *("velocity", "resonator_velocity", "resonator_displacement"),
        *("slider_mass", "resonator_mass", "resonator_frequency"),
    )
    spring = small * frequency * frequency
    moving = mass * velocity**2 + small * (velocity + swing) ** 2
    return 0.5 * (moving + spring * displacement**2)


def heats(instance: Instance) -> tuple[float, float]:
    """Heat of a period by the output, and by the balance of energy [J].

    That is what the drive supplies and is not kept, by Gauss quadrature between events.
    """
    begin = BEGIN * TURN
    state, energy_before = instance.state(), energy(instance)
    (before,) = instance.get("position")
    events = {begin, begin + TURN, *(begin + TURN * k / PIECES for k in range(1, PIECES))}
    for _ in range(400):
        instance.step(TURN / 400)
        events.add(instance.get("last_event_time")[0])
    edges = sorted(t for t in events if begin <= t <= begin + TURN)
    instance.restore(state)
    instance.time = begin
    mass, frequency, damping, base, force, deviation, load = instance.get(
        *("resonator_mass", "resonator_frequency", "damping_ratio", "base_amplitude"),
        *("tangential_force", "amplitude_deviation", "load"),
    )
    drive, direct = (x * (1.0 + deviation) for x in (mass * base * 3500.0**2, force))
    supplied = 0.0
    for low, high in pairwise(edges):
        half = 0.5 * (high - low)
        for node, weight in zip((NODES + 1.0) * half + low, WEIGHTS * half, strict=True):
            instance.step(float(node) - instance.time)
            velocity, swing = instance.get("velocity", "resonator_velocity")
            sine = math.sin(3500.0 * instance.time)
            lost = 2.0 * damping * mass * frequency * swing * swing
            supplied += weight * (drive * sine * (velocity + swing) + direct * sine * velocity)
            supplied -= weight * lost
    instance.step(begin + TURN - instance.time)
    (after, power) = instance.get("position", "friction_power")
    supplied -= load * (after - before) + energy(instance) - energy_before
    return power * TURN, supplied


@pytest.mark.parametrize("case", CASES)
def test_friction_balances_energy(instantiate: Instantiate, case: str) -> None:
    """On bristles the energy is known to the tolerance of the velocity."""
    instance = instantiate().initialize(**{"tolerance": TOLERANCE, **CASES[case]})
    instance.step(BEGIN * TURN)
    heat, balance = heats(instance)
    assert heat > 0.0, "friction heats"
    bristles = 2.0 * TOLERANCE * energy(instance)
    allowed = bristles if "friction_law" in CASES[case] else 1e-9 * heat
    assert heat == pytest.approx(balance, abs=allowed)


def test_before_a_period_is_complete_it_is_the_mean_since_the_start(
    instantiate: Instantiate,
) -> None:
    instance = instantiate().initialize(initial_velocity=0.3)
    friction, velocity, power = instance.get("friction_force", "velocity", "friction_power")
    assert power == friction * velocity
    instance.step(0.3 * TURN)
    half = instance.get("friction_power")[0]
    instance.step(0.7 * TURN)
    whole = instance.get("friction_power")[0]
    assert 0.0 < half != whole > 0.0
    instance.step(0.4 * TURN)
    assert instance.get("friction_power") == (whole,), "then that of the last whole one"


@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("last", [0.3, 2.9, 40.2])
def test_long_steps_give_the_power_of_short_ones(
    instantiate: Instantiate, last: float, law: int
) -> None:
    """Work counts near the end of a step alone, wherever the step began and ends."""
    powers = []
    for steps in ([30.4, last], [0.38] * 80 + [last / 8] * 8):
        instance = instantiate().initialize(friction_law=law, phase=0.4)
        for size in steps:
            instance.step(size * TURN)
        powers.append(instance.get("friction_power")[0])
    assert powers[0] == pytest.approx(powers[1], rel=1e-12 if law == 0 else 1e-6)


def test_averaged_power_is_bounded_work_at_any_ratio(instantiate: Instantiate) -> None:
    """What a rapid normal load adds falls with the square of the ratio."""
    powers = []
    for ratio in (999.0, 10001.0, 1e300):
        values = {"fidelity": 0, "averaging_order": 1, "phase": 0.7, "frequency_ratio": ratio}
        instance = instantiate().initialize(**values)
        instance.step(0.5 * TURN)
        powers.append(instance.get("friction_power")[0])
    far = powers.pop()
    for power, allowed in zip(powers, (1e-5, 1e-7), strict=True):
        assert power == pytest.approx(far, rel=allowed)
