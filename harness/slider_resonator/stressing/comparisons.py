"""Runs that must agree: in other steps, from another start time, with the reference."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.natural_scale import fast_velocity, largest_fast_velocity
from slider_resonator.device.device import FULL
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.stressing.case import MARGIN, MEAN, MIN_DIVISIBLE, SIGNALS, Case, Observation
from slider_resonator.stressing.invariants import BoundCheck, largest

REFERENCE = "reference"
"""Name of the check against a reference that shares no code with the FMU."""
NO_REFERENCE = "no reference"
"""Name of the check that reports why a reference gave up."""
EXACT = 1e-10
"""Error of resolved motion by rounding, as a fraction of peaks, where events are the same."""
AVERAGED = 1e-7
"""The same of averaged motion: the errors, 1e-9 each, of a hundred internal steps."""
REFERENCE_ERROR = 1e-6
"""Error of the averaged reference, as a fraction of peaks; each of its steps keeps 1e-8."""
CONDITIONING = 10.0
"""Largest deviation, over that of a reference whose values are off by the allowed error."""

Signals = Mapping[str, Array]
GAVE_UP = (RuntimeError, ValueError, ArithmeticError)
"""What a reference raises where it cannot follow a motion."""


def equalities(case: Case, seen: Observation) -> Iterator[BoundCheck]:
    """Yield the checks against other runs of the same motion, and of limit cases."""
    own = {name: seen.outputs[name] for name in SIGNALS}
    # Leaps leave transients of the resonator out: ten times what they may.
    left_out = 1e-5 if case.model.leaps else 0.0
    allowed = _allowed(case, own, _numerics(case) + left_out)
    last = {name: signal[-1:] for name, signal in own.items()}
    for name, other in seen.others.items():
        yield _largest(name, last, other, allowed)
    yield BoundCheck("replay", 2.0 * (not seen.replayed), "a run from the same start differs")
    for limit in case.limits:
        off = seen.outputs[limit.output][-1:] - limit.value
        yield largest("limit case", off, limit.allowed, f"{limit.why}: {limit.output}")


def compare_with_reference(case: Case, seen: Observation) -> BoundCheck:
    """Return the check against the reference, or one that says why that gave up."""
    try:
        expected = _expected(case)
    except GAVE_UP as error:
        return BoundCheck(NO_REFERENCE, 0.0, f"the reference gave up: {error}", is_deviation=False)
    allowed = _allowed_of_reference(case, expected)
    return _largest(REFERENCE, _compared(case, seen.outputs), expected, allowed)


def is_sensitive(case: Case, found: float) -> bool:
    """Return whether the reference itself, with values off by the allowed error, is as far off.

    `found` is the deviation of an FMU, in units of the allowed one.
    """
    by = _numerics(case) + (REFERENCE_ERROR if case.model.averages else 0.0)
    tuned = {name for hold in case.holds for name, _ in hold.tuned}
    moved = dict(case.settings)
    for name in ("initial_velocity", "initial_resonator_velocity", "base_amplitude"):
        if name not in tuned:
            moved[name] = getattr(case.device, name) * (1.0 + by)
    holds = [replace(h, phase=h.phase + by, load=h.load * (1.0 + by)) for h in case.holds]
    try:
        expected = _expected(case)
        near = _expected(replace(case, parameters=moved, holds=tuple(holds)))
    except GAVE_UP:
        return False
    own = _largest("", near, expected, _allowed_of_reference(case, expected))
    return found <= CONDITIONING * own.found


def has_reference(case: Case) -> bool:
    """Return whether a reference covers the case at an acceptable cost.

    That of averages takes friction under a mean load, and a vibration; the resolved one is run over
    few periods, and not against stiffness.
    """
    if case.is_random or case.start_time:
        return case.is_random
    device, smallest = case.device, case.sizes.min()
    if device.fidelity == 0:
        if smallest <= MIN_DIVISIBLE:
            return False
        try:
            fast = fast_velocity(device)
        except OverflowError:
            return False
        # With bristles longer runs take more quadratures than all other cases together.
        longest = 5000.0 * device.total_mass * fast
        rubs = fast > 0.0 and device.mean_friction > 0.0
        if not rubs or device.friction_law * case.duration * device.mean_friction > longest:
            return False
    if case.model.averages:
        return True
    ratio = max(1.0, float(np.abs(case.inputs[:, 2]).max()))
    slider = max(1.0 - device.mass_ratio, 1e-12)
    fastest = max(ratio * device.drive_frequency, device.resonator_frequency / math.sqrt(slider))
    decay = device.damping_ratio * device.resonator_frequency / slider
    max_periods = 2000.0 if case.model.leaps else 600.0  # leaps are in long steps
    undamped = device.fidelity == 1 and device.damping_ratio < 1e-9
    # Faster decay, smaller steps (s) and more changes of inputs take a reference minutes.
    is_soft = decay <= 30.0 * device.drive_frequency and smallest >= 1e-9
    is_short = case.duration * fastest <= math.tau * max_periods and len(case.holds) <= 400
    return is_soft and is_short and not undamped


def _expected(case: Case) -> Signals:
    """Return the signals of the reference that are compared.

    Raises what that does, and ArithmeticError where they leave the range of numbers.
    """
    device, held, times = case.device, case.held, case.times
    if case.model.averages:
        return _compared(case, vars(simulate_averaged(device, held, times)))
    if case.model.leaps:  # judged by resolved motion of the full device
        device = device.tuned([("fidelity", FULL)])
    with np.errstate(over="ignore", invalid="ignore"):
        signals = vars(simulate(device, held, times))
    if not all(np.isfinite(signals[name]).all() for name in SIGNALS):
        raise ArithmeticError("its motion leaves the range of floating point numbers")
    return _compared(case, signals)


def _compared(case: Case, outputs: Signals) -> Signals:
    """Return what is compared, of leaps velocity (m/s) and position (m) of the centre of mass.

    These are X' + r Y' and X + r Y: what is left of a transient of the resonator does not move
    slider and resonator as one mass.
    """
    if case.model.leaps:
        share = case.device.mass_ratio
        return {
            "centre velocity": outputs["velocity"] + share * outputs["resonator_velocity"],
            "centre": outputs["position"] + share * outputs["resonator_displacement"],
        }
    if case.model.averages:
        # Before the first step there is no mean over a period.
        return {name: outputs[name][name == "mean_velocity" :] for name in MEAN}
    return {name: outputs[name] for name in SIGNALS}


def _numerics(case: Case) -> float:
    """Return the error of a motion, as a fraction of peaks.

    It is rounding, of the drive angle too, or the steps of averaged motion, and `tolerance` where
    that counts.
    """
    device, model = case.device, case.model
    ratios = np.maximum(1.0, np.abs(case.inputs[:, 2]))
    angle = float((device.drive_frequency * ratios * case.sizes).sum())
    rounding = 4.0 * float(np.finfo(float).eps) * angle
    if model.averages:
        return AVERAGED + rounding
    return EXACT + rounding + device.tolerance * (MARGIN if model.leaps else model.friction_law)


def _allowed_of_reference(case: Case, expected: Signals) -> dict[str, float]:
    """Return the allowed deviation of each signal that is compared with a reference."""
    device = case.device
    peaks = {name: float(np.abs(signal).max()) for name, signal in expected.items()}
    if case.model.leaps:
        own = EXACT + device.tolerance * device.friction_law
        velocity = MARGIN * device.tolerance * largest_fast_velocity(device, case.held)
        leaps = {"centre velocity": velocity, "centre": velocity * case.duration}
        return {name: leaps[name] + own * peak for name, peak in peaks.items()}
    if case.model.averages:
        fast = fast_velocity(device)
        floors = {"mean_velocity": fast, "position": fast / device.drive_frequency}
        share = REFERENCE_ERROR + _numerics(case)
        return {name: share * max(peak, floors[name]) for name, peak in peaks.items()}
    return _allowed(case, expected, _numerics(case))


def _allowed(case: Case, signals: Signals, share: float) -> dict[str, float]:
    """Return the allowed deviation of the four signals: a share of their scales, and rounding.

    Scales are peaks, with the resonator's share in the slider, as steps may always meet the same
    phase. With LuGre friction they hold what friction does in a period. The error of the velocity
    by `tolerance`, of LuGre friction and of leaps, accumulates in the position.
    """
    device, time = case.device, case.duration
    w = device.drive_frequency
    position, velocity, swing, rate = (float(np.abs(signals[name]).max()) for name in SIGNALS)
    swing = max(swing, rate / w)
    friction = device.max_friction
    slip = device.friction_law * friction / (device.total_mass * w)
    velocity += device.mass_ratio * w * swing + slip
    force = friction + float(np.abs(case.inputs[:, 1]).max()) + abs(device.tangential_force)
    force += device.resonator_mass * device.base_amplitude * w**2
    off = 8.0 * float(np.finfo(float).eps) * force * time / device.slider_mass
    drift = off * time
    if case.model.leaps:
        drift += MARGIN * device.tolerance * largest_fast_velocity(device, case.held) * time
    elif device.friction_law == 1 and device.fidelity > 0:
        drift += device.tolerance * velocity * time
    return {
        "position": share * max(position, velocity / w) + drift,
        "velocity": share * velocity + off,
        "resonator_displacement": share * (swing + slip / w) + off * time,
        "resonator_velocity": share * (w * swing + slip) + off,
    }


def _largest(name: str, own: Signals, other: Signals, allowed: Mapping[str, float]) -> BoundCheck:
    """Return the check of the signal that is farthest off."""
    checks = (largest(name, own[key] - other[key], allowed[key], key) for key in allowed)
    return max(checks, key=lambda check: check.found)
