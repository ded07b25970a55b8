"""heyoka at its fastest on a slider that never sticks: a motion under constant inputs in one call.

One compiled system per friction law; the direction of sliding is a runtime parameter that an event
callback reverses where the velocity is zero. With LuGre friction the bristle deflection follows
from the path since the last reversal. It covers neither sticking nor flight: `simulate_sliding`
refuses devices that lift, and a start at rest.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from time import process_time
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import LugreTrajectory, Trajectory
from slider_resonator.trading.peers.peer import NOT_SHOT, Peer, solution_of
from slider_resonator.trading.solution import Solution

_PARAMETERS = (
    *("mass", "mass_base", "damping", "stiffness", "base", "direct", "frequency"),
    *("normal_frequency", "phase", "load", "preload", "amplitude", "direction"),
    *("bristle_rate", "drag", "reversed_at", "stretch"),
)
_PLACE = {name: index for index, name in enumerate(_PARAMETERS)}
_LAST = ("direction", "stretch")
"""The last parameter in use, by friction law."""


def heyoka_in_one_call(family: str, tolerance: float) -> Peer:
    """Return heyoka in one call; it starts where the reference is after one drive period."""

    def follow(device: Device, held: Sequence[HeldInputs], times: Array) -> Solution:
        if len(held) != 1 or held[0].vary:
            raise ValueError("inputs vary, which it does not cover")
        (inputs,) = held
        begin = min(2.0 * np.pi / device.drive_frequency, inputs.stop)
        early = times[times <= begin]
        began = process_time()
        start = simulate(device, [replace(inputs, stop=begin)], np.append(early, begin))
        started = process_time() - began
        if begin == inputs.stop:
            return replace(
                solution_of(start, located=False),
                times=early,
                position=start.position[:-1],
                velocity=start.velocity[:-1],
            )
        if start.contact_mode[-1] == 0:
            raise ValueError("the slider sticks after a drive period, which it does not cover")
        moving = device_at(device, start, -1)
        later = times[times > begin]
        rest = simulate_sliding(moving, inputs, later, tolerance=tolerance, start=begin)
        return Solution(
            times,
            position=np.concatenate([start.position[:-1], rest.samples[:, 0]]),
            velocity=np.concatenate([start.velocity[:-1], rest.samples[:, 1]]),
            steps=rest.steps,
            events=rest.reversals,
            start_cpu=started,
        )

    missing = {"event_times": "the times of reversals are not reported", **NOT_SHOT}
    setting = f"tol {tolerance:.0e}"
    return Peer(family, setting, tolerance, follow, cannot_stick=True, missing=missing)


def device_at(device: Device, run: Trajectory, index: int) -> Device:
    """Return the device that starts in the state of a trajectory at one of its samples."""
    names = ("position", "velocity", "resonator_displacement", "resonator_velocity")
    state: dict[str, Any] = {f"initial_{name}": float(getattr(run, name)[index]) for name in names}
    bent = run.bristle_deflection[index] if isinstance(run, LugreTrajectory) else 0.0
    return replace(device, **state, initial_bristle_deflection=float(bent))


@dataclass(frozen=True)
class SlidingRun:
    """States `samples` (n, 4): position, velocity, resonator displacement and velocity.

    `reversals` and `steps` count over the run.
    """

    samples: Array
    reversals: int
    steps: int


def simulate_sliding(
    device: Device,
    inputs: HeldInputs,
    times: Array,
    *,
    tolerance: float,
    start: float | None = None,
) -> SlidingRun:
    """Follow a moving slider to the stop of `inputs` (s), theta = psi = 0 at their start.

    The initial state is that at `start` (s), by default the start of the inputs. `times` (s, shape
    (n,)) ascend from there. `tolerance` is the relative one of a Taylor step. The first call with a
    `tolerance` compiles. Raises ValueError for what is not covered; RuntimeError when heyoka fails;
    ModuleNotFoundError without heyoka.
    """
    if device.normal_amplitude > device.normal_preload:
        raise ValueError("normal_amplitude above normal_preload: the contact lifts")
    if device.initial_velocity == 0.0 or device.fidelity != 2 or device.resonator_mass == 0.0:
        raise ValueError("only full devices with initial_velocity not 0 are covered")
    integrator, counter = _compiled(device.friction_law, tolerance)
    _set(integrator, device, inputs)
    counter.reversals = 0
    integrator.time = 0.0 if start is None else start - inputs.start
    integrator.reset_cooldowns()
    state = [0.0, device.initial_velocity]
    state += [device.initial_resonator_displacement, device.initial_resonator_velocity]
    stretch = device.bristle_stiffness * device.initial_bristle_deflection
    stretch /= device.friction_coefficient
    if device.friction_law == 1:
        integrator.pars[_PLACE["stretch"]] = stretch
    integrator.state[:] = state
    grid = np.union1d(times - inputs.start, [integrator.time, inputs.stop - inputs.start])
    outcome, *_, steps, _, states = integrator.propagate_grid(grid.tolist())
    if "time_limit" not in str(outcome):
        raise RuntimeError(f"heyoka ended after {steps} steps with {outcome}")
    samples = np.array(states)[np.searchsorted(grid, times - inputs.start), :4]
    samples[:, 0] += device.initial_position
    return SlidingRun(samples, counter.reversals, steps)


class _Counter:
    reversals = 0


@cache
def _compiled(friction_law: int, tolerance: float) -> tuple[Any, _Counter]:
    try:
        hy = importlib.import_module("heyoka")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "this peer needs heyoka: pip install 'slider-resonator[taylor]'"
        ) from error
    x, v, y, u = hy.make_vars("x", "v", "y", "u")
    par = {name: hy.par[index] for name, index in _PLACE.items()}
    angle = par["frequency"] * hy.time
    normal = par["preload"] + par["amplitude"] * hy.sin(
        par["normal_frequency"] * hy.time + par["phase"]
    )
    rate = par["bristle_rate"]
    share = par["direction"]
    if friction_law == 1:
        fade = hy.exp(-rate * par["direction"] * (x - par["reversed_at"]))
        stretch = par["direction"] - (par["direction"] - par["stretch"]) * fade
        # sigma_1 z' / mu, with z the stretch s0 z / mu: sigma_1 v (1 - direction z) / mu.
        share = stretch + par["drag"] * v * (1.0 - par["direction"] * stretch)
    acceleration = (
        par["damping"] * u
        + par["stiffness"] * y
        + par["direct"] * hy.sin(angle)
        - par["load"]
        - normal * share
    ) / par["mass"]
    swing = (
        par["base"] * hy.sin(angle)
        - (par["damping"] * u + par["stiffness"] * y) / par["mass_base"]
        - acceleration
    )
    system = [(x, v), (v, acceleration), (y, u), (u, swing)]
    counter = _Counter()

    def reverse(integrator: Any, sign: int) -> bool:
        pars = integrator.pars
        direction, position = pars[_PLACE["direction"]], integrator.state[0]
        if friction_law == 1:
            moved = position - pars[_PLACE["reversed_at"]]
            lacking = direction - pars[_PLACE["stretch"]]
            fade = math.exp(-pars[_PLACE["bristle_rate"]] * direction * moved)
            pars[_PLACE["stretch"]] = direction - lacking * fade
            pars[_PLACE["reversed_at"]] = position
        pars[_PLACE["direction"]] = -direction
        counter.reversals += 1
        return True

    event = hy.t_event(v, callback=reverse)
    integrator = hy.taylor_adaptive(
        system,
        [0.0] * len(system),
        pars=[0.0] * (_PLACE[_LAST[friction_law]] + 1),
        tol=tolerance,
        t_events=[event],
    )
    # A copy made by heyoka would keep its own callback, so the counter is found by the original.
    return integrator, counter


def _set(integrator: Any, device: Device, inputs: HeldInputs) -> None:
    faces = device.friction_faces * device.friction_coefficient
    mass, wn = device.resonator_mass, device.resonator_frequency
    w = device.drive_frequency
    values = {
        "mass": device.slider_mass,
        "mass_base": mass,
        "damping": 2.0 * device.damping_ratio * mass * wn,
        "stiffness": mass * wn * wn,
        "base": device.base_amplitude * w * w,
        "direct": device.tangential_force,
        "frequency": w,
        "normal_frequency": inputs.frequency_ratio * w,
        "phase": inputs.phase,
        "load": inputs.load,
        "preload": faces * device.normal_preload,
        "amplitude": faces * device.normal_amplitude,
        "bristle_rate": device.bristle_stiffness / device.friction_coefficient,
        "drag": device.bristle_damping / device.friction_coefficient,
        "direction": math.copysign(1.0, device.initial_velocity),
        "reversed_at": 0.0,
    }
    for name, value in values.items():
        if _PLACE[name] < len(integrator.pars):
            integrator.pars[_PLACE[name]] = value
