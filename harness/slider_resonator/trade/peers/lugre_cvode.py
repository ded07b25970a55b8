"""LuGre friction (8) by CVODE's BDF with the bristle as a state: a stiff solver.

No event is located; the solver steps over the kinks at the reversals. A peer for measurements of
cost, not a reference.
"""

from __future__ import annotations

from math import sin
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.trade.peers.sundials import MAX_STEPS, cvode
from slider_resonator.trade.peers.switching_taylor import SlidingRun


def simulate_lugre_cvode(
    device: Device, inputs: HeldInputs, times: Array, *, tolerance: float
) -> SlidingRun:
    """Follow a device from the start of `inputs` to their stop (s), theta = psi = 0 at the start.

    `times` (s, shape (n,)) ascend. `tolerance` is relative and, in fractions of a typical motion,
    absolute. Reversals and steps are not counted. Raises ValueError for Coulomb friction and other
    fidelities than 2; RuntimeError when the solver gives up; ModuleNotFoundError without
    scikit-sundae.
    """
    if device.friction_law != 1 or device.fidelity != 2 or device.resonator_mass == 0.0:
        raise ValueError("only LuGre friction (friction_law 1) on the full device is covered")
    w, mass, slider = device.drive_frequency, device.resonator_mass, device.slider_mass
    wn, mu = device.resonator_frequency, device.friction_coefficient
    spring, damper = mass * wn * wn, 2.0 * device.damping_ratio * mass * wn
    base, direct, load = device.base_amplitude * w * w, device.tangential_force, inputs.load
    preload, amplitude = device.normal_preload, device.normal_amplitude
    q, phase, faces = inputs.frequency_ratio * w, inputs.phase, device.friction_faces
    bend, drag = device.bristle_stiffness / mu, device.bristle_damping

    def slopes(t: float, state: Array, change: Array) -> None:
        _, velocity, displacement, rate, bent = state.tolist()
        normal = max(0.0, preload + amplitude * sin(q * t + phase))
        # The state is s0 z, so that its size is that of mu.
        relative = velocity - abs(velocity) * bent / mu
        friction = faces * normal * (bent + drag * relative)
        resonator = damper * rate + spring * displacement
        acceleration = (resonator + direct * sin(w * t) - load - friction) / slider
        swing = base * sin(w * t) - resonator / mass - acceleration
        change[:] = (velocity, acceleration, rate, swing, bend * mu * relative)

    speed = base * mass / (w * (slider + mass)) + abs(device.initial_velocity)
    solver: Any = cvode()(
        slopes,
        method="BDF",
        rtol=tolerance,
        atol=tolerance * np.array([speed / w, speed, speed / w, speed, mu]),
        max_num_steps=MAX_STEPS,
    )
    start = [device.initial_position, device.initial_velocity]
    start += [device.initial_resonator_displacement, device.initial_resonator_velocity]
    start.append(device.bristle_stiffness * device.initial_bristle_deflection)
    local = times - inputs.start
    solution = solver.solve(np.union1d(local, [0.0, inputs.stop - inputs.start]), np.array(start))
    if not solution.success:
        raise RuntimeError(f"CVODE gave up: {solution.message}")
    samples = np.array(solution.y)[np.searchsorted(solution.t, local), :4]
    return SlidingRun(samples, evaluations=int(solution.nfev))
