"""Statements on the device with its resonator, and on frequencies that differ."""

from __future__ import annotations

from math import ceil, pi

import numpy as np

from slider_resonator.checks.measures.frequency import dominant_frequency
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged import averaged_coulomb
from slider_resonator.references.closed_forms import equivalent_force
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.studies.paper.claim import AGREES, DISAGREES, PARTLY, Claim, ClaimGroup, near
from slider_resonator.studies.paper.figure_7 import CASE, PERIOD, STOP_PERIODS, averaged_trajectory
from slider_resonator.studies.paper.figure_8 import DEVICE, velocity_at
from slider_resonator.studies.paper.measure import record, steady_velocity

DETUNINGS = (1.0, 2.0, 4.0, 8.0)
BEATS = 6
SETTLING = 20.0
"""Ten times the decay time pi q / 2 of (6)."""
NON_INTEGERS = (0.25, 0.5, 1.5, 2.5, 1.2)


def _models(instance: Instance) -> list[Claim]:
    both = {
        f: record(instance, {**CASE, "fidelity": f}, STOP_PERIODS * PERIOD, STOP_PERIODS)
        for f in (1, 2)
    }
    speeds = {f: steady_velocity(instance, {**CASE, "fidelity": f}) for f in (1, 2)}
    difference = both[1]["position"] - both[2]["position"]
    late = difference[STOP_PERIODS // 2 :]
    times = both[1].times
    theory = averaged_trajectory(1, times)[0] - averaged_trajectory(2, times)[0]
    third = {
        f: steady_velocity(instance, {"fidelity": f, "phase": 0.4, "frequency_ratio": 3.0})
        for f in (1, 2)
    }
    return [
        Claim(
            "one_degree_of_freedom_velocity",
            "3.2, fig. 7b",
            "Model (34) has nearly the steady velocity of the full device",
            {"one": speeds[1], "two": speeds[2]},
            AGREES,
            "the resonator hardly feels friction: r_m times friction against F_T",
            near(speeds[1], speeds[2], 0.02),
        ),
        Claim(
            "constant_offset",
            "3.2, fig. 7a",
            "The displacements of the two models differ by a constant",
            {
                "offset": float(late[-1]),
                "change_over_last_half": float(np.ptp(late)),
                "averaged_theory": float(theory[-1]),
            },
            PARTLY,
            "nearly: the steady velocities differ a little, so that it still creeps. It is the "
            "different slow velocity at the start, q cos(theta_1) against r_m a Omega, "
            "summed over the transient; the resonator's own transient adds the rest",
            float(np.ptp(late)) < 0.15 * abs(float(late[-1])),
        ),
        Claim(
            "reduction_at_other_frequencies",
            "section 4",
            "The reduction to one degree of freedom does not hold where the two frequencies differ",
            {"one_at_ratio_3_m_per_s": third[1], "two_at_ratio_3_m_per_s": third[2]},
            DISAGREES,
            "only friction carries the normal frequency, and the reduction needs no more than "
            "friction small against the drive: at ratio 3 the two agree",
            near(third[1], third[2], 0.02),
        ),
    ]


def _ratios(instance: Instance) -> list[Claim]:
    phases = np.linspace(0.0, 2.0 * pi, 17)[:-1].tolist()
    strongest = {
        n: max(abs(velocity_at(instance, p, float(n)) or 0.0) for p in phases) for n in (1, 3, 5, 7)
    }
    force = equivalent_force(DEVICE)
    blocked = {}
    for n in (1, 3, 5):
        best = pi / 2.0 - n * force.angle
        found = find_blocking(instance, {"phase": best, "frequency_ratio": float(n)})
        blocked[n] = abs(found.blocking_force or 0.0)
    others = {r: max(abs(velocity_at(instance, p, r) or 0.0) for p in phases) for r in NON_INTEGERS}
    return [
        Claim(
            "ratio_one_strongest",
            "section 4, fig. 8a, b",
            "Equal frequencies give the largest velocity and blocking force",
            {
                **{f"largest_velocity_ratio_{n}": v for n, v in strongest.items()},
                **{f"blocking_force_N_ratio_{n}": v for n, v in blocked.items()},
            },
            AGREES,
            "the average at an integer ratio n has the drive alpha / n",
            strongest[1] > 2.0 * max(strongest[n] for n in (3, 5, 7))
            and blocked[1] > 2.0 * max(blocked[3], blocked[5]),
        ),
        Claim(
            "sliding_at_other_ratios",
            "section 4, fig. 8a, d",
            "Frequencies that differ much still give steady sliding, though weaker",
            {
                "largest_velocity_ratio_3": strongest[3],
                **{f"largest_velocity_ratio_{r:g}": v for r, v in others.items()},
            },
            PARTLY,
            "at odd ratios, with 1 / n of the drive; between integers the averaged drive vanishes "
            "and what is left is below 1e-3 x0 w0",
            strongest[3] > 0.2 and max(others.values()) < 1e-3,
        ),
    ]


def _beat(instance: Instance, ratio: float, detuning: float) -> tuple[float, float]:
    """Return angular frequency (rad/s) and amplitude (x0) of the beat near an integer ratio."""
    step = 2.0 * pi / detuning / 100.0
    settled = ceil(SETTLING / step)
    points = settled + BEATS * 100
    values = {"frequency_ratio": ratio + detuning / DEVICE.drive_frequency}
    run = record(instance, values, points * step, points)
    position = run["position"][settled:] / equivalent_force(DEVICE).length_scale
    frequency = 2.0 * pi * dominant_frequency(run.times[settled:], position)
    return frequency, float(np.ptp(position[-101:])) / 2.0


def _beats(instance: Instance) -> list[Claim]:
    force = equivalent_force(DEVICE)
    frequencies, amplitudes = {}, {}
    for detuning in DETUNINGS:
        frequencies[detuning], amplitudes[detuning] = _beat(instance, 1.0, detuning)
    near_three = _beat(instance, 3.0, 2.0)[0]
    linear = {
        d: averaged_coulomb.linear_beat_displacement(force.strength, 1.0, d) for d in DETUNINGS
    }
    return [
        Claim(
            "beat_frequency",
            "section 4, appendix A, fig. 8c",
            "A small detuning makes the slider oscillate at exactly the difference frequency",
            {
                **{f"rad_per_s_at_detuning_{d:g}": f for d, f in frequencies.items()},
                "rad_per_s_near_ratio_3_at_2": near_three,
            },
            AGREES,
            "the phase runs through a turn in 2 pi / DeltaOmega, (A.2), and so near ratio 3",
            all(near(f, d, 5e-3) for d, f in frequencies.items()) and near(near_three, 2.0, 5e-3),
        ),
        Claim(
            "beat_amplitude",
            "section 4, fig. 8c",
            "The amplitude of that oscillation falls as the detuning grows",
            {
                **{f"amplitude_at_detuning_{d:g}": a for d, a in amplitudes.items()},
                **{f"linear_theory_at_detuning_{d:g}": a for d, a in linear.items()},
            },
            AGREES,
            "from (A.3) as 1 / DeltaOmega for slow and 1 / DeltaOmega^2 for fast beats; the full "
            "(A.2) is below it where the velocity nears q",
            bool(np.all(np.diff(list(amplitudes.values())) < 0.0)),
        ),
    ]


GROUP = ClaimGroup(
    "claims_resonator",
    "The device with its resonator, and frequencies that differ",
    (_models, _ratios, _beats),
)
