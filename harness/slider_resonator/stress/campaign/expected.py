"""What a reference expects of a case, and how far an FMU may be off."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import FULL, Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.device.schedule import Schedule
from slider_resonator.references.averaged.averaged_motion import AveragedMotion, simulate_averaged
from slider_resonator.references.closed_forms import equivalent_force
from slider_resonator.references.resolved.lugre_taylor import simulate_lugre
from slider_resonator.references.resolved.taylor import simulate
from slider_resonator.references.resolved.trajectory import LugreTrajectory, Trajectory
from slider_resonator.stress.campaign.random_case import RandomCase

RESOLVED = ("position", "velocity", "resonator_displacement", "resonator_velocity")
AVERAGED = ("position", "mean_velocity")
EXACT = 1e-10
"""Error of resolved motion with Coulomb friction, over the peaks: rounding, at events too."""
AVERAGED_ERROR = 1.1e-6
"""Error of averaged motion and its reference, over the peaks: their steps keep 1e-9 and 1e-8."""
PEAK_SAMPLES = 50
"""Times besides the communication points at which peaks are looked for."""
CONDITIONING = 10.0
"""Largest deviation, over that of a reference whose values are off by the allowed error."""


@dataclass(frozen=True)
class Expected:
    """Signals at the communication points, shape (n,), and their allowed deviations.

    `resolution` is the relative error that is allowed of the motion in the peaks.
    """

    signals: Mapping[str, Array]
    allowed: Mapping[str, float]
    resolution: float


def expected(case: RandomCase) -> Expected:
    """Return what the reference of the case expects; raises what that does."""
    return _expected(case, case.device, 0.0)


def moved(case: RandomCase, by: float) -> Expected:
    """Return the same with friction, loads and start off by a share `by`."""
    device = case.device
    start = {
        name: getattr(device, name) * (1.0 + by)
        for name in ("initial_velocity", "initial_resonator_velocity", "base_amplitude")
        if name not in case.schedule.tuning
    }
    return _expected(case, replace(device, **start), by)


def _expected(case: RandomCase, device: Device, by: float) -> Expected:
    held = [
        replace(inputs, phase=inputs.phase + by, load=inputs.load * (1.0 + by))
        for inputs in case.schedule.held()
    ]
    own = case.schedule.times
    times = np.union1d(own, np.linspace(own[0], own[-1], PEAK_SAMPLES))
    if case.second_order:
        device = replace(device, fidelity=FULL)
    names = AVERAGED if device.fidelity == 0 else RESOLVED
    with np.errstate(over="ignore", invalid="ignore"):
        motion = _simulate(device, held, times)
    everywhere = {name: np.asarray(getattr(motion, name), dtype=np.float64) for name in names}
    if not all(np.isfinite(signal).all() for signal in everywhere.values()):
        raise ArithmeticError("the motion leaves the range of floating point numbers")
    places = np.searchsorted(times, own)
    resolution = _resolution(device, case.schedule)
    peaks = _peaks(device, case.schedule, everywhere)
    return Expected(
        {name: signal[places] for name, signal in everywhere.items()},
        {name: resolution * peak for name, peak in peaks.items()},
        resolution,
    )


def _simulate(
    device: Device, held: Sequence[HeldInputs], times: Array
) -> AveragedMotion | Trajectory | LugreTrajectory:
    if device.fidelity == 0:
        return simulate_averaged(device, held, times)
    if device.friction_law == 0:
        return simulate(device, held, times)
    return simulate_lugre(device, held, times)


def _resolution(device: Device, schedule: Schedule) -> float:
    """Rounding, of the angles too, and the errors of integration."""
    ratio = max(1.0, float(np.abs(schedule.sampled()[:, 2]).max()))
    turned = 1.2 * ratio * device.drive_frequency * float(schedule.times[-1])
    rounding = 8.0 * float(np.finfo(float).eps) * turned
    if device.fidelity == 0:
        return AVERAGED_ERROR + rounding
    return EXACT + rounding + 3.0 * device.tolerance * device.friction_law


def _peaks(device: Device, schedule: Schedule, signals: Mapping[str, Array]) -> dict[str, float]:
    """Peaks of slider and resonator, which move each other; positions count in turns too."""
    w, share = device.drive_frequency, device.mass_ratio
    peak = {name: float(np.abs(signal).max()) for name, signal in signals.items()}
    try:
        fast = equivalent_force(device).velocity_amplitude
    except ValueError:  # undamped resonance
        fast = 0.0
    if device.fidelity == 0:
        velocity = max(peak["mean_velocity"], fast)
        turns = w * float(schedule.times[-1])
        return {
            "position": max(peak["position"], velocity / w * max(1.0, turns)),
            "mean_velocity": velocity,
        }
    swing = max(peak["resonator_displacement"], peak["resonator_velocity"] / w)
    rate = max(peak["resonator_velocity"], w * swing)
    velocity = max(peak["velocity"], fast) + share * rate
    turns = max(1.0, w * float(schedule.times[-1]))
    return {
        "position": max(peak["position"], velocity / w * turns),
        "velocity": velocity,
        "resonator_displacement": swing + velocity / w,
        "resonator_velocity": rate + velocity,
    }
