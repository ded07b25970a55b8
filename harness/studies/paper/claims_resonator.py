"""Statements on the device with its resonator, and on frequencies that differ."""

from collections.abc import Iterator
from math import ceil, pi

import numpy as np

from slider_resonator.checks.measures import dominant_frequency
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.equivalent_force import equivalent_force
from studies.paper import slow_theory
from studies.paper.claim import Claim, ClaimGroup, claim, labelled, near
from studies.paper.figure_7 import CASE, PERIOD, STOP_PERIODS
from studies.paper.figure_8 import DEVICE, velocity_at
from studies.paper.measure import blocking_force, record, steady_velocity

DETUNINGS = (1.0, 2.0, 4.0, 8.0)
BEATS = 6
SETTLING = 20.0
"""Ten times the decay time pi q / 2 of (6)."""
NON_INTEGERS = (0.25, 0.5, 1.5, 2.5, 1.2)


def _models(instance: Instance) -> Iterator[Claim]:
    one, two = (
        record(instance, {**CASE, "fidelity": f}, STOP_PERIODS * PERIOD, STOP_PERIODS)
        for f in (1, 2)
    )
    speeds = {f: steady_velocity(instance, {**CASE, "fidelity": f}) for f in (1, 2)}
    yield claim(
        "one_degree_of_freedom_velocity",
        near(speeds[1], speeds[2], 0.02),
        {"one": speeds[1], "two": speeds[2]},
    )
    late = (one["position"] - two["position"])[STOP_PERIODS // 2 :]
    creep = float(np.ptp(late))
    expected = abs(speeds[1] - speeds[2]) * PERIOD * (len(late) - 1)
    yield claim(
        "constant_offset",
        near(creep, expected, 0.01) and abs(float(late[-1])) < 0.02 * float(two["position"][-1]),
        {
            "offset": late[-1],
            "travel": two["position"][-1],
            "change_over_last_half": creep,
            "by_steady_velocities": expected,
        },
    )
    third = {
        f: steady_velocity(instance, {"fidelity": f, "phase": 0.4, "frequency_ratio": 3.0})
        for f in (1, 2)
    }
    yield claim(
        "reduction_at_other_frequencies",
        near(third[1], third[2], 0.02),
        {"one_at_ratio_3_m_per_s": third[1], "two_at_ratio_3_m_per_s": third[2]},
    )


def _ratios(instance: Instance) -> Iterator[Claim]:
    phases = np.linspace(0.0, 2.0 * pi, 17)[:-1].tolist()

    def largest(ratio: float) -> float:
        return max(abs(velocity_at(instance, phase, ratio) or 0.0) for phase in phases)

    def blocked(ratio: float) -> float:
        best = pi / 2.0 - ratio * equivalent_force(DEVICE).angle
        return abs(blocking_force(instance, {"phase": best, "frequency_ratio": ratio}))

    strongest = {n: largest(n) for n in (1.0, 3.0, 5.0, 7.0)}
    forces = {n: blocked(n) for n in (1.0, 3.0, 5.0)}
    yield claim(
        "ratio_one_strongest",
        strongest[1] > 2.0 * max(strongest[n] for n in (3, 5, 7))
        and forces[1] > 2.0 * max(forces[3], forces[5]),
        labelled("largest_velocity_ratio", strongest) | labelled("blocking_force_N_ratio", forces),
    )
    others = {ratio: largest(ratio) for ratio in NON_INTEGERS}
    yield claim(
        "sliding_at_other_ratios",
        strongest[3] > 0.2 and max(others.values()) < 1e-3,
        labelled("largest_velocity_ratio", {3.0: strongest[3], **others}),
    )


def _beat(instance: Instance, ratio: float, detuning: float) -> tuple[float, float]:
    """Return angular frequency (rad/s) and amplitude (x0) of the beat near an integer ratio."""
    step = 2.0 * pi / detuning / 100.0
    settled = ceil(SETTLING / step)
    points = settled + BEATS * 100
    values = {"frequency_ratio": ratio + detuning / DEVICE.drive_frequency}
    run = record(instance, values, points * step, points)
    position = run["position"][settled:] / slow_theory.length_scale(DEVICE)
    frequency = 2.0 * pi * dominant_frequency(run.times[settled:], position)
    return frequency, float(np.ptp(position[-101:])) / 2.0


def _beats(instance: Instance) -> Iterator[Claim]:
    strength = slow_theory.strength_of(DEVICE)
    beats = {detuning: _beat(instance, 1.0, detuning) for detuning in DETUNINGS}
    frequencies = {detuning: frequency for detuning, (frequency, _) in beats.items()}
    amplitudes = {detuning: amplitude for detuning, (_, amplitude) in beats.items()}
    near_three = _beat(instance, 3.0, 2.0)[0]
    yield claim(
        "beat_frequency",
        all(near(f, d, 5e-3) for d, f in frequencies.items()) and near(near_three, 2.0, 5e-3),
        {
            **labelled("rad_per_s_at_detuning", frequencies),
            "rad_per_s_near_ratio_3_at_2": near_three,
        },
    )
    linear = {d: slow_theory.linear_beat_displacement(strength, 1.0, d) for d in DETUNINGS}
    yield claim(
        "beat_amplitude",
        bool(np.all(np.diff(list(amplitudes.values())) < 0.0)),
        labelled("amplitude_at_detuning", amplitudes)
        | labelled("linear_theory_at_detuning", linear),
    )


GROUP = ClaimGroup(
    "claims_resonator",
    "The device with its resonator, and frequencies that differ",
    (_models, _ratios, _beats),
)
