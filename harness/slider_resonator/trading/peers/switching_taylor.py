"""heyoka at its fastest on a slider that never sticks: a motion under constant inputs in one call.

The system is compiled for a device and its inputs; the direction of sliding is a parameter that an
event callback reverses where the velocity is zero. With LuGre friction the bristle deflection
follows from the path since the last reversal. It covers neither sticking nor flight:
`simulate_sliding` refuses devices that lift, and a start at rest.
"""

import importlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from time import process_time
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.solution import Solution, solution_of

_STATE = ("position", "velocity", "resonator_displacement", "resonator_velocity")
_AT_REST: dict[str, Any] = {f"initial_{name}": 0.0 for name in (*_STATE, "bristle_deflection")}
DIRECTION, REVERSED_AT, STRETCH = range(3)
"""Parameters that change in a run; only the first with Coulomb friction."""


def heyoka_in_one_call(
    device: Device, held: Sequence[HeldInputs], times: Array, *, tolerance: float
) -> Solution:
    """Follow a motion; it starts where the reference is after one drive period.

    Raises ValueError for what is not covered, besides what `simulate_sliding` raises.
    """
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


def device_at(device: Device, run: Trajectory, index: int) -> Device:
    """Return the device that starts in the state of a trajectory at one of its samples."""
    state: dict[str, Any] = {f"initial_{name}": float(getattr(run, name)[index]) for name in _STATE}
    return replace(device, **state, initial_bristle_deflection=float(run.bristle_deflection[index]))


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
    (n,)) ascend from there. `tolerance` is the relative one of a Taylor step. The first call for a
    device compiles. Raises ValueError for what is not covered; RuntimeError when heyoka fails;
    ModuleNotFoundError without heyoka.
    """
    if device.normal_amplitude > device.normal_preload:
        raise ValueError("normal_amplitude above normal_preload: the contact lifts")
    if device.initial_velocity == 0.0 or device.fidelity != 2 or device.resonator_mass == 0.0:
        raise ValueError("only full devices with initial_velocity not 0 are covered")
    now = (inputs.phase, inputs.load, inputs.frequency_ratio)
    integrator, counter = _compiled(replace(device, **_AT_REST), now, tolerance)
    counter.reversals = 0
    integrator.time = 0.0 if start is None else start - inputs.start
    integrator.reset_cooldowns()
    integrator.pars[DIRECTION] = math.copysign(1.0, device.initial_velocity)
    if device.friction_law == 1:
        bent = device.bristle_stiffness * device.initial_bristle_deflection
        integrator.pars[REVERSED_AT] = 0.0
        integrator.pars[STRETCH] = bent / device.friction_coefficient
    integrator.state[:] = [
        *(0.0, device.initial_velocity),
        *(device.initial_resonator_displacement, device.initial_resonator_velocity),
    ]
    grid = np.union1d(times - inputs.start, [integrator.time, inputs.stop - inputs.start])
    outcome, *_, steps, _, states = integrator.propagate_grid(grid.tolist())
    if "time_limit" not in str(outcome):
        raise RuntimeError(f"heyoka ended after {steps} steps with {outcome}")
    samples = np.array(states)[np.searchsorted(grid, times - inputs.start), :4]
    samples[:, 0] += device.initial_position
    return SlidingRun(samples, counter.reversals, steps)


class _Counter:
    reversals = 0


@lru_cache(maxsize=16)
def _compiled(
    device: Device, inputs: tuple[float, float, float], tolerance: float
) -> tuple[Any, _Counter]:
    """Compile a device at rest under phase (rad), load (N) and frequency ratio."""
    try:
        hy = importlib.import_module("heyoka")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "this peer needs heyoka: pip install 'slider-resonator[taylor]'"
        ) from error
    x, v, y, u = hy.make_vars("x", "v", "y", "u")
    phase, load, ratio = inputs
    w, wn, mass = device.drive_frequency, device.resonator_frequency, device.resonator_mass
    limit = device.friction_faces * device.friction_coefficient
    rate = device.bristle_stiffness / device.friction_coefficient
    drag = device.bristle_damping / device.friction_coefficient
    drive = hy.sin(w * hy.time)
    varying = device.normal_amplitude * hy.sin(ratio * w * hy.time + phase)
    spring = 2.0 * device.damping_ratio * mass * wn * u + mass * wn * wn * y
    direction = share = hy.par[DIRECTION]
    if device.friction_law == 1:
        fade = hy.exp(-rate * direction * (x - hy.par[REVERSED_AT]))
        stretch = direction - (direction - hy.par[STRETCH]) * fade
        # sigma_1 z' / mu, with z the stretch s0 z / mu: sigma_1 v (1 - direction z) / mu.
        share = stretch + drag * v * (1.0 - direction * stretch)
    friction = limit * (device.normal_preload + varying) * share
    force = spring + device.tangential_force * drive - load - friction
    acceleration = force / device.slider_mass
    swing = device.base_amplitude * w * w * drive - spring / mass - acceleration
    counter = _Counter()

    def reverse(integrator: Any, sign: int) -> bool:
        pars = integrator.pars
        turned, position = pars[DIRECTION], integrator.state[0]
        if device.friction_law == 1:
            fade = math.exp(-rate * turned * (position - pars[REVERSED_AT]))
            pars[STRETCH] = turned - (turned - pars[STRETCH]) * fade
            pars[REVERSED_AT] = position
        pars[DIRECTION] = -turned
        counter.reversals += 1
        return True

    system = [(x, v), (v, acceleration), (y, u), (u, swing)]
    parameters = [0.0] * (3 if device.friction_law == 1 else 1)
    event = hy.t_event(v, callback=reverse)
    integrator = hy.taylor_adaptive(
        system, [0.0] * len(system), pars=parameters, tol=tolerance, t_events=[event]
    )
    # A copy made by heyoka would keep its own callback, so the counter is found by the original.
    return integrator, counter
