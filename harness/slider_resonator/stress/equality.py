"""Runs that must agree: in other steps, from another start time, with the reference."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.leap_error import MARGIN
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.lugre_taylor import simulate_lugre
from slider_resonator.references.resolved.taylor import simulate
from slider_resonator.references.resolved.trajectory import LugreTrajectory, Trajectory
from slider_resonator.stress import averaged_reference, second_order_reference
from slider_resonator.stress.case import MatrixCell
from slider_resonator.stress.observe import NAMES, Observation
from slider_resonator.stress.verdict import NO_REFERENCE, REFERENCE, BoundCheck

SIGNALS = ("position", "velocity", "resonator_displacement", "resonator_velocity")
EXACT = 1e-10
"""Deviation of resolved motion by rounding, as a fraction of peaks, where events are the same."""
AVERAGED = 1e-7
"""The same of averaged motion: the errors, 1e-9 each, of a hundred internal steps."""
LEFT_OUT = 1e-5
"""Transients of the resonator that leaps leave out, ten times what they may."""
MAX_TURNS = 600.0
"""Turns of the fastest oscillation up to which the reference is run."""
MAX_LEAPT_TURNS = 2000.0
"""The same with averages of second order: the long steps in which they leap."""
MAX_HOLDS = 400
"""Changes of inputs up to which the reference is run."""
MAX_DECAY = 30.0
"""Fastest decay, in drive frequencies, up to which the reference is run."""


def equalities(cell: MatrixCell, seen: Observation) -> Iterator[BoundCheck]:
    """Yield the checks against other runs of the same motion."""
    yield _compare_last("other steps", cell, seen, seen.other)
    if seen.from_zero is not None:
        yield _compare_last("from time 0", cell, seen, seen.from_zero)
    words = "a run from the same start or stored state differs"
    yield BoundCheck("replay", 0.0 if seen.replayed else 2.0, words)
    for limit in cell.limits:
        off = abs(float(seen.signal(limit.output)[-1]) - limit.value)
        found = off / limit.allowed if limit.allowed else 2.0 * float(off > 0.0)
        words = f"{limit.output} off by {off:.3g}, allowed {limit.allowed:.3g}: {limit.why}"
        yield BoundCheck("limit case", found, words)
    if has_reference(cell):
        yield _compare_with_reference(cell, seen)


def allowed_deviation(cell: MatrixCell, seen: Observation) -> float:
    """Return the deviation between two runs of a motion, as a fraction of peaks.

    It is rounding, of the drive angle too, or the steps of averaged motion, and `tolerance` where
    that counts.
    """
    device = cell.device
    ratios = np.maximum(1.0, np.abs(seen.inputs[:, 2]))
    angle = float((device.drive_frequency * ratios * seen.sizes).sum())
    rounding = 4.0 * float(np.finfo(float).eps) * angle
    if cell.model.second_order:
        return EXACT + rounding + LEFT_OUT + MARGIN * device.tolerance
    if device.fidelity == 0:
        return AVERAGED + rounding
    return EXACT + rounding + device.tolerance * device.friction_law


def has_reference(cell: MatrixCell) -> bool:
    """Return whether a reference covers the cell at an acceptable cost."""
    device = cell.device
    if device.fidelity == 0 and not averaged_reference.covers(cell):
        return False
    if device.fidelity == 0 and not cell.model.second_order:
        return True
    if cell.start_time or len(cell.holds) > MAX_HOLDS:
        return False
    if device.fidelity == 1 and device.damping_ratio < 1e-9:
        return False
    if device.friction_law == 1 and device.friction_coefficient == 0.0:
        return False
    duration = sum(hold.size * hold.count for hold in cell.holds)
    ratio = max(1.0, *(abs(hold.frequency_ratio) for hold in cell.holds))
    fastest = max(
        ratio * device.drive_frequency,
        device.resonator_frequency / math.sqrt(max(1.0 - device.mass_ratio, 1e-12)),
    )
    decay = device.damping_ratio * device.resonator_frequency / max(1.0 - device.mass_ratio, 1e-12)
    if decay > MAX_DECAY * device.drive_frequency or min(h.size for h in cell.holds) < 1e-9:
        return False
    max_turns = MAX_LEAPT_TURNS if cell.model.second_order else MAX_TURNS
    return duration * fastest <= math.tau * max_turns


def _compare_with_reference(cell: MatrixCell, seen: Observation) -> BoundCheck:
    ends = np.cumsum([0, *(hold.count for hold in cell.holds)])
    times = np.concatenate([[0.0], np.cumsum(seen.sizes)])
    held = [
        HeldInputs(float(times[first]), float(times[last]), *hold.inputs)
        for first, last, hold in zip(ends, ends[1:], cell.holds, strict=False)
    ]
    try:
        if cell.model.second_order:
            full = _resolved(second_order_reference.full_device(cell), held, times)
            motion = dict(zip(SIGNALS, full, strict=True))
            own = EXACT + cell.device.tolerance * cell.device.friction_law
            return second_order_reference.compare(cell, seen, held, motion, own)
        if cell.device.fidelity == 0:
            own = allowed_deviation(cell, seen)
            return averaged_reference.compare(cell, seen, held, times, own)
        resolved = _resolved(cell.device, held, times)
    except (RuntimeError, ValueError, ArithmeticError) as error:
        return BoundCheck(NO_REFERENCE, 0.0, f"the reference gave up: {error}", is_deviation=False)
    return _compare(REFERENCE, cell, seen, resolved)


def _resolved(device: Device, held: Sequence[HeldInputs], times: Array) -> list[Array]:
    """Return the four signals; ArithmeticError where they leave the range of numbers."""
    with np.errstate(over="ignore", invalid="ignore"):
        if device.friction_law == 0:
            motion: Trajectory | LugreTrajectory = simulate(device, held, times)
        else:
            motion = simulate_lugre(device, held, times)
    signals = [getattr(motion, name) for name in SIGNALS]
    if not np.isfinite(signals).all():
        raise ArithmeticError("its motion leaves the range of floating point numbers")
    return signals


def _compare_last(name: str, cell: MatrixCell, seen: Observation, other: Array) -> BoundCheck:
    last = [np.append(seen.signal(signal)[:-1], other[NAMES.index(signal)]) for signal in SIGNALS]
    return _compare(name, cell, seen, last)


def _compare(name: str, cell: MatrixCell, seen: Observation, other: Sequence[Array]) -> BoundCheck:
    """Compare four signals, each with its own scale."""
    scales = _scales(cell, seen)
    worst, words = 0.0, ""
    for signal, scale, floor, motion in zip(
        SIGNALS, scales, _rounding(cell, seen), other, strict=True
    ):
        off = float(np.abs(seen.signal(signal) - motion).max())
        allowed = allowed_deviation(cell, seen) * scale + floor
        found = off / allowed if allowed else 2.0 * float(off > 0.0)
        if not found <= worst:
            worst = found
            words = f"{signal} off by {off:.3g}, {off / scale if scale else 1:.3g} of its peak"
    return BoundCheck(name, worst, words)


def _scales(cell: MatrixCell, seen: Observation) -> tuple[float, float, float, float]:
    """Peaks, with the resonator's share in the slider; steps may always meet the same phase.

    The tolerance of LuGre friction refers to what friction does in a turn as well.
    """
    device = cell.device
    w, share = device.drive_frequency, device.mass_ratio
    position, velocity, swing, rate = (float(np.abs(seen.signal(s)).max()) for s in SIGNALS)
    swing = max(swing, rate / w)
    slip = 0.0
    if device.friction_law == 1:
        slip = _max_friction(device) / (device.total_mass * w)
    velocity += share * w * swing + slip
    return max(position, velocity / w), velocity, swing + slip / w, w * swing + slip


def _rounding(cell: MatrixCell, seen: Observation) -> tuple[float, float, float, float]:
    """Return the effect of rounding in the forces on the four signals over the run.

    With LuGre friction the error `tolerance` of the velocity accumulates in the position.
    """
    device = cell.device
    time = float(seen.sizes.sum())
    force = _max_friction(device) + float(np.abs(seen.inputs[:, 1]).max())
    force += abs(device.tangential_force)
    force += device.resonator_mass * device.base_amplitude * device.drive_frequency**2
    velocity = 8.0 * np.finfo(float).eps * force * time / device.slider_mass
    drift = velocity * time
    if device.friction_law == 1 and device.fidelity > 0:
        drift += device.tolerance * _scales(cell, seen)[1] * time
    return drift, velocity, velocity * time, velocity


def _max_friction(device: Device) -> float:
    max_normal = device.normal_preload + device.normal_amplitude
    return device.friction_faces * device.friction_coefficient * max_normal
