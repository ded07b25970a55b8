"""Bounds, and those that hold for every motion of the device, whatever the parameters."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.checks.natural_scale import fast_velocity
from slider_resonator.stressing.case import MARGIN, Case, Observation

Exact = NDArray[np.longdouble]

ROUNDING = float(np.finfo(float).eps)
BOUND = 1e-9
"""Rounding allowed in a bound, as a fraction of the quantities in it."""


@dataclass(frozen=True)
class BoundCheck:
    """One bound: the largest deviation found, in units of the allowed one.

    `is_deviation` is false for counts and yes-or-no answers, which have no distance to a bound.
    """

    name: str
    found: float
    words: str = ""
    is_deviation: bool = True

    @property
    def passed(self) -> bool:
        """Whether the bound holds; it does not for NaN."""
        return self.found <= 1.0


def largest(name: str, off: Array, allowed: float | Array, what: str = "") -> BoundCheck:
    """Return the check of the largest deviation `off`, of `what`; where 0 is allowed, it must be 0.

    NaN breaks the bound.
    """
    off = np.abs(np.asarray(off, dtype=float))
    shares = np.nan_to_num(off / np.maximum(allowed, np.finfo(float).tiny), nan=np.inf)
    found = float(shares.max())
    words = f"{what} off by up to {off.max():.3g}, {found:.3g} times the allowed"
    return BoundCheck(name, found, words.lstrip())


def finite(seen: Observation) -> BoundCheck:
    """Return the check that all outputs are finite numbers."""
    wrong = [name for name, column in seen.outputs.items() if not np.isfinite(column).all()]
    wrong += [
        name for name, last in seen.others.items() if not np.isfinite(list(last.values())).all()
    ]
    return BoundCheck("finite", 2.0 if wrong else 0.0, f"not finite: {', '.join(wrong)}")


def invariants(case: Case, seen: Observation) -> Iterator[BoundCheck]:
    """Yield the checks of everything that must hold by the equations (26)-(27) alone."""
    # Drive angle and that of the load (rad) after each step, in extended precision, from 0.
    w = np.longdouble(case.device.drive_frequency)
    turns = w * np.concatenate([[0.0], case.sizes]).astype(np.longdouble)
    ratios = np.concatenate([[0.0], case.inputs[:, 2]]).astype(np.longdouble)
    theta, psi = np.cumsum(turns), np.cumsum(ratios * turns)
    yield _phase(case, seen, psi)
    yield _friction_bound(case, seen)
    if case.device.friction_law == 0 or case.device.friction_coefficient == 0.0:
        yield _momentum(case, seen, theta)
    driven = case.device.base_amplitude or case.device.tangential_force
    if case.device.fidelity == 2 and not driven and not any(hold.load for hold in case.holds):
        yield _energy(case, seen)
    yield _share(seen)


def _phase(case: Case, seen: Observation, psi: Exact) -> BoundCheck:
    """The normal load is max(0, N0 + dN sin(psi + phase)) at all times: no phase drifts."""
    device = case.device
    held = np.concatenate([case.inputs[:1, 0], case.inputs[:, 0]])
    swing = device.normal_amplitude * np.sin(psi + held)
    expected = np.maximum(0.0, (device.normal_preload + swing).astype(float))
    angle = np.abs(psi).astype(float) + np.abs(held)
    bound = BOUND * device.max_normal_force
    allowed = bound + 4.0 * ROUNDING * angle * device.normal_amplitude
    return largest("phase of the normal load", seen.outputs["normal_force"] - expected, allowed)


def _friction_bound(case: Case, seen: Observation) -> BoundCheck:
    """|F| <= faces mu N, and with LuGre friction what the damping of the bristle adds.

    By (8) |s0 z| <= mu and |z'| <= 2 |v|. An averaged motion is judged with the largest N.
    """
    device = case.device
    normal = seen.outputs["normal_force"]
    averaged = case.model.averages
    if averaged:
        normal = np.full_like(normal, device.max_normal_force)
    share = np.full_like(normal, device.friction_coefficient)
    if device.friction_law == 1:
        velocity = np.abs(seen.outputs["velocity"])
        if averaged:
            velocity = np.abs(seen.outputs["mean_velocity"]) + fast_velocity(device)
        share += 2.0 * device.bristle_damping * velocity
    force = np.abs(seen.outputs["friction_force"])
    allowed = BOUND * device.friction_faces * share * device.max_normal_force
    return largest(
        "friction bound", np.maximum(0.0, force - device.friction_faces * share * normal), allowed
    )


def _momentum(case: Case, seen: Observation, theta: Exact) -> BoundCheck:
    """Momentum changes by the drive, the load, and friction of at most faces mu max(N).

    The averaged motion has the momentum (M+m) V - D cos(theta) with D the impulse of the drive; at
    fidelity 1 a mean over a period may differ from that by the vibration itself, with averages of
    second order by the error of leaps.
    """
    device = case.device
    drive = device.resonator_mass * device.base_amplitude * device.drive_frequency
    drive += device.tangential_force / device.drive_frequency
    body = device.total_mass * seen.outputs["velocity"]
    resonator = device.resonator_mass * seen.outputs["resonator_velocity"]
    slack = 0.0
    if device.fidelity == 2 or case.model.leaps:
        momentum = body + resonator - drive * (1.0 - np.cos(theta)).astype(float)
        if case.model.leaps:
            slack = MARGIN * device.tolerance * device.total_mass * fast_velocity(device)
    else:
        momentum = device.total_mass * seen.outputs["mean_velocity"]
        if device.fidelity == 0:
            started = device.resonator_mass * device.initial_resonator_velocity
            momentum[0] = device.total_mass * device.initial_velocity + started + drive
        else:
            slack = 2.0 * float(np.abs(body - momentum).max())
    load = np.concatenate([[0.0], np.cumsum(case.inputs[:, 1] * case.sizes)])
    friction = device.max_friction * case.times
    change = np.abs(momentum - momentum[0] + load)
    sizes = abs(drive) + (np.abs(body) + np.abs(resonator)).max() + np.abs(load) + friction
    rounding = (BOUND + 4.0 * ROUNDING * theta.astype(float)) * sizes
    return largest("momentum", np.maximum(0.0, change - friction - slack), rounding)


def _energy(case: Case, seen: Observation) -> BoundCheck:
    """Without drive and load, kinetic and spring energy never grow, and never fall undamped."""
    device = case.device
    velocity, rate = seen.outputs["velocity"], seen.outputs["resonator_velocity"]
    energy = 0.5 * device.slider_mass * velocity**2
    energy += 0.5 * device.resonator_mass * (velocity + rate) ** 2
    energy += 0.5 * device.stiffness * seen.outputs["resonator_displacement"] ** 2
    gained = np.diff(energy)
    if device.damping_ratio == 0.0 and device.friction_coefficient == 0.0:
        gained = energy - energy[0]
    else:
        gained = np.maximum(0.0, gained)
    allowed = BOUND * (float(energy[0]) or 1.0)
    if device.friction_law == 1:  # bristles bent to mu / s0 give energy back
        bent = 0.5 * device.friction_coefficient**2 / device.bristle_stiffness
        allowed += device.friction_faces * device.max_normal_force * bent
    return largest("energy", gained, allowed)


def _share(seen: Observation) -> BoundCheck:
    """Shares lie between 0 and 1, contact modes are known, counts never fall."""
    stick = seen.outputs["stick_fraction"]
    wrong = float(np.maximum(stick - 1.0, -stick).max() > BOUND)
    wrong += float(not np.isin(seen.outputs["contact_mode"], (-1.0, 0.0, 1.0, 2.0)).all())
    wrong += float((np.diff(seen.outputs["reversals"]) < 0.0).any())
    wrong += float((np.diff(seen.outputs["last_event_time"]) < 0.0).any())
    return BoundCheck(
        "counts and shares", 2.0 * wrong, "share outside 0 to 1, mode unknown or count fell"
    )
