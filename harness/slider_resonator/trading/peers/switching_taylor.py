"""heyoka at its fastest on a slider that never sticks: a motion under constant inputs in one call.

The system is compiled for a device and its inputs; the direction of sliding is a parameter that an
event callback reverses where the velocity is zero. With LuGre friction the bristle deflection
follows from the path since the last reversal. It covers neither sticking nor flight.
"""

import importlib
import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from time import process_time
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.equations import equations_of
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.problem import Solution

DIRECTION, REVERSED_AT, STRETCH = range(3)
"""Parameters that change in a run; only the first with Coulomb friction."""


def heyoka_in_one_call(
    device: Device, held: Sequence[HeldInputs], times: Array, *, tolerance: float
) -> Solution:
    """Follow a motion; it starts where the reference is after a drive period, or half of the run.

    `tolerance` is the relative one of a Taylor step. The first call for a device compiles. Raises
    ValueError for what is not covered; RuntimeError when heyoka fails; ModuleNotFoundError without
    heyoka.
    """
    if len(held) != 1 or held[0].vary:
        raise ValueError("inputs vary, which it does not cover")
    if device.normal_amplitude > device.normal_preload:
        raise ValueError("normal_amplitude above normal_preload: the contact lifts")
    if device.resonator_mass == 0.0:
        raise ValueError("resonator_mass = 0: only full devices are covered")
    (inputs,) = held
    begin = min(2.0 * np.pi / device.drive_frequency, 0.5 * inputs.stop)
    early, later = times[times <= begin], times[times > begin]
    began = process_time()
    start = simulate(device, [replace(inputs, stop=begin)], np.append(early, begin))
    started = process_time() - began
    direction = float(start.contact_mode[-1])
    if direction == 0.0:
        raise ValueError("the slider sticks after a drive period, which it does not cover")
    now = (inputs.phase, inputs.load, inputs.frequency_ratio)
    integrator, reversals = _compiled(device, now, tolerance)
    reversals.clear()
    integrator.time = begin - inputs.start
    integrator.reset_cooldowns()
    integrator.pars[DIRECTION] = direction
    if device.friction_law == 1:
        bent = float(start.bristle_deflection[-1])
        integrator.pars[REVERSED_AT] = 0.0
        integrator.pars[STRETCH] = bent * equations_of(device).path_rate
    motion = (start.velocity, start.resonator_displacement, start.resonator_velocity)
    integrator.state[:] = [0.0, *(float(values[-1]) for values in motion)]
    ends = [integrator.time, inputs.stop - inputs.start]
    grid = np.union1d(later - inputs.start, ends)
    outcome, *_, steps, _, states = integrator.propagate_grid(grid.tolist())
    if "time_limit" not in str(outcome):
        raise RuntimeError(f"heyoka ended after {steps} steps with {outcome}")
    position, velocity, *_ = np.array(states)[np.searchsorted(grid, later - inputs.start)].T
    return Solution(
        times,
        position=np.concatenate([start.position[:-1], start.position[-1] + position]),
        velocity=np.concatenate([start.velocity[:-1], velocity]),
        steps=steps,
        events=len(reversals),
        start_cpu=started,
    )


@lru_cache(maxsize=16)
def _compiled(
    device: Device, inputs: tuple[float, float, float], tolerance: float
) -> tuple[Any, list[float]]:
    """Return an integrator under phase (rad), load (N) and ratio, and where it reverses (m)."""
    try:
        hy = importlib.import_module("heyoka")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "this peer needs heyoka: pip install 'slider-resonator[taylor]'"
        ) from error
    x, v, y, u = hy.make_vars("x", "v", "y", "u")
    phase, load, ratio = inputs
    e = equations_of(device)
    drive = hy.sin(e.drive_frequency * hy.time)
    varying = e.friction_amplitude * hy.sin(ratio * e.drive_frequency * hy.time + phase)
    direction = share = hy.par[DIRECTION]
    if e.path_rate:
        fade = hy.exp(-e.path_rate * direction * (x - hy.par[REVERSED_AT]))
        stretch = direction - (direction - hy.par[STRETCH]) * fade
        share = stretch + e.path_damping * v * (1.0 - direction * stretch)
    force = e.coupling_damping * u + e.coupling_stiffness * y + e.force_sine * drive - load
    acceleration = (force - (e.friction_mean + varying) * share) / e.inertia
    swing = e.base_acceleration * drive - e.damping_rate * u - e.stiffness_rate * y - acceleration
    reversals: list[float] = []

    def reverse(integrator: Any, sign: int) -> bool:
        pars = integrator.pars
        turned, position = pars[DIRECTION], integrator.state[0]
        if e.path_rate:
            fade = math.exp(-e.path_rate * turned * (position - pars[REVERSED_AT]))
            pars[STRETCH] = turned - (turned - pars[STRETCH]) * fade
            pars[REVERSED_AT] = position
        pars[DIRECTION] = -turned
        reversals.append(position)
        return True

    system = [(x, v), (v, acceleration), (y, u), (u, swing)]
    parameters = [0.0] * (3 if e.path_rate else 1)
    event = hy.t_event(v, callback=reverse)
    integrator = hy.taylor_adaptive(
        system, [0.0] * len(system), pars=parameters, tol=tolerance, t_events=[event]
    )
    return integrator, reversals
