"""Bounds that hold for every motion of the device, whatever the parameters."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.leap_error import MARGIN
from slider_resonator.checks.natural_scale import fast_velocity
from slider_resonator.device.device import Device
from slider_resonator.references.closed_forms import equivalent_force
from slider_resonator.stress.case import MatrixCell
from slider_resonator.stress.observe import NAMES, Observation
from slider_resonator.stress.verdict import BoundCheck

Exact = NDArray[np.longdouble]

ROUNDING = float(np.finfo(float).eps)
BOUND = 1e-9
"""Rounding allowed in a bound, as a fraction of the quantities in it."""


def invariants(cell: MatrixCell, seen: Observation) -> Iterator[BoundCheck]:
    """Yield the checks of everything that must hold by the equations (26)-(27) alone."""
    yield _finite(seen)
    theta, psi = _angles(cell, seen)
    yield _phase(cell, seen, psi)
    yield _friction_bound(cell, seen)
    if cell.device.friction_law == 0 or cell.device.friction_coefficient == 0.0:
        yield _momentum(cell, seen, theta)
    if _undriven(cell):
        yield _energy(cell, seen)
    yield _share(seen)


def _finite(seen: Observation) -> BoundCheck:
    wrong = [
        name for name, column in zip(NAMES, seen.outputs.T, strict=False)
        if not np.isfinite(column).all()
    ]  # fmt: skip
    wrong = wrong if np.isfinite(seen.other).all() else [*wrong, "the other partition"]
    return BoundCheck("finite", 2.0 if wrong else 0.0, f"not finite: {', '.join(wrong)}")


def _angles(cell: MatrixCell, seen: Observation) -> tuple[Exact, Exact]:
    """Return theta and psi (rad) after each step, in extended precision, from 0."""
    w = np.longdouble(cell.device.drive_frequency)
    turns = w * np.concatenate([[0.0], seen.sizes]).astype(np.longdouble)
    ratios = np.concatenate([[0.0], seen.inputs[:, 2]]).astype(np.longdouble)
    return np.cumsum(turns), np.cumsum(ratios * turns)


def _phase(cell: MatrixCell, seen: Observation, psi: Exact) -> BoundCheck:
    """The normal load is max(0, N0 + dN sin(psi + phase)) at all times: no phase drifts."""
    device = cell.device
    held = np.concatenate([seen.inputs[:1, 0], seen.inputs[:, 0]])
    swing = device.normal_amplitude * np.sin(psi + held)
    expected = np.maximum(0.0, (device.normal_preload + swing).astype(float))
    angle = np.abs(psi).astype(float) + np.abs(held)
    bound = BOUND * (device.normal_preload + device.normal_amplitude)
    allowed = bound + 4.0 * ROUNDING * angle * device.normal_amplitude
    return _largest("phase of the normal load", seen.signal("normal_force") - expected, allowed)


def _friction_bound(cell: MatrixCell, seen: Observation) -> BoundCheck:
    """|F| <= faces mu N, and with LuGre friction what the damping of the bristle adds.

    By (8) |s0 z| <= mu and |z'| <= 2 |v|. An averaged motion is judged with the largest N.
    """
    device = cell.device
    normal = seen.signal("normal_force")
    max_normal = device.normal_preload + device.normal_amplitude
    averaged = device.fidelity == 0 and not cell.model.second_order
    if averaged:
        normal = np.full_like(normal, max_normal)
    share = np.full_like(normal, device.friction_coefficient)
    if device.friction_law == 1:
        velocity = np.abs(seen.signal("velocity"))
        if averaged:
            velocity = np.abs(seen.signal("mean_velocity")) + _vibration(device)
        share += 2.0 * device.bristle_damping * velocity
    force = np.abs(seen.signal("friction_force"))
    allowed = BOUND * device.friction_faces * share * max_normal
    return _largest(
        "friction bound", np.maximum(0.0, force - device.friction_faces * share * normal), allowed
    )


def _vibration(device: Device) -> float:
    """Amplitude of the fast velocity, m/s, (32) over mass and frequency."""
    rubbing = replace(device, friction_coefficient=1.0, normal_preload=1.0)
    force: float = equivalent_force(rubbing).amplitude
    return abs(force) / (device.total_mass * device.drive_frequency)


def _momentum(cell: MatrixCell, seen: Observation, theta: Exact) -> BoundCheck:
    """Momentum changes by the drive, the load, and friction of at most faces mu max(N).

    The averaged motion has the momentum (M+m) V - D cos(theta) with D the impulse of the drive; at
    fidelity 1 a mean over a period may differ from that by the vibration itself, with averages of
    second order by the error of leaps.
    """
    device = cell.device
    drive = device.resonator_mass * device.base_amplitude * device.drive_frequency
    drive += device.tangential_force / device.drive_frequency
    body = device.total_mass * seen.signal("velocity")
    resonator = device.resonator_mass * seen.signal("resonator_velocity")
    slack = 0.0
    max_normal = device.normal_preload + device.normal_amplitude
    max_friction = device.friction_faces * device.friction_coefficient * max_normal
    if device.fidelity == 2 or cell.model.second_order:
        momentum = body + resonator - drive * (1.0 - np.cos(theta)).astype(float)
        if cell.model.second_order:
            slack = MARGIN * device.tolerance * device.total_mass * fast_velocity(device)
    else:
        momentum = device.total_mass * seen.signal("mean_velocity")
        if device.fidelity == 0:
            started = device.resonator_mass * device.initial_resonator_velocity
            momentum[0] = device.total_mass * device.initial_velocity + started + drive
        else:
            slack = 2.0 * float(np.abs(body - momentum).max())
    load = np.concatenate([[0.0], np.cumsum(seen.inputs[:, 1] * seen.sizes)])
    time = np.concatenate([[0.0], np.cumsum(seen.sizes)])
    friction = max_friction * time
    change = np.abs(momentum - momentum[0] + load)
    sizes = abs(drive) + (np.abs(body) + np.abs(resonator)).max() + np.abs(load) + friction
    rounding = (BOUND + 4.0 * ROUNDING * theta.astype(float)) * sizes
    return _largest("momentum", np.maximum(0.0, change - friction - slack), rounding)


def _undriven(cell: MatrixCell) -> bool:
    device = cell.device
    forced = device.base_amplitude or device.tangential_force or device.fidelity != 2
    return not forced and not any(hold.load for hold in cell.holds)


def _energy(cell: MatrixCell, seen: Observation) -> BoundCheck:
    """Without drive and load, kinetic and spring energy never grow, and never fall undamped."""
    device = cell.device
    velocity, rate = seen.signal("velocity"), seen.signal("resonator_velocity")
    energy = 0.5 * device.slider_mass * velocity**2
    energy += 0.5 * device.resonator_mass * (velocity + rate) ** 2
    energy += 0.5 * device.stiffness * seen.signal("resonator_displacement") ** 2
    gained = np.diff(energy)
    if device.damping_ratio == 0.0 and device.friction_coefficient == 0.0:
        gained = energy - energy[0]
    else:
        gained = np.maximum(0.0, gained)
    allowed = BOUND * (float(energy[0]) or 1.0)
    if device.friction_law == 1:
        allowed += _stored_in_bristles(device)
    return _largest("energy", gained, allowed)


def _stored_in_bristles(device: Device) -> float:
    """Energy in J that bristles bent to mu / s0 give back."""
    bent = 0.5 * device.friction_coefficient**2 / device.bristle_stiffness
    return device.friction_faces * (device.normal_preload + device.normal_amplitude) * bent


def _share(seen: Observation) -> BoundCheck:
    """Shares lie between 0 and 1, contact modes are known, counts never fall."""
    stick = seen.signal("stick_fraction")
    wrong = float(np.maximum(stick - 1.0, -stick).max() > BOUND)
    wrong += float(not np.isin(seen.signal("contact_mode"), (-1.0, 0.0, 1.0, 2.0)).all())
    wrong += float((np.diff(seen.signal("reversals")) < 0.0).any())
    wrong += float((np.diff(seen.signal("last_event_time")) < 0.0).any())
    return BoundCheck(
        "counts and shares", 2.0 * wrong, "share outside 0 to 1, mode unknown or count fell"
    )


def _largest(
    name: str, deviation: NDArray[np.float64], allowed: float | NDArray[np.float64]
) -> BoundCheck:
    """Return a check of the largest deviation; where 0 is allowed, the deviation must be 0."""
    deviation = np.abs(np.asarray(deviation, dtype=float))
    floor = np.finfo(float).tiny
    found = float(np.max(deviation / np.maximum(allowed, floor)))
    worst = float(np.max(deviation))
    return BoundCheck(name, found, f"off by up to {worst:.3g}, {found:.3g} times the allowed")
