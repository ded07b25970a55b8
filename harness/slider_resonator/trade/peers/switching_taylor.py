"""heyoka at its fastest on a slider that never sticks: the peer for measurements of cost.

One compiled system per friction law; the direction of sliding is a runtime parameter that an event
callback reverses where the velocity is zero, so that a whole run is one call. It covers neither
sticking nor flight: `simulate_sliding` refuses devices that lift, and a start at rest.
"""

from __future__ import annotations

import importlib
import math
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs

Form = Literal["coulomb", "path", "state"]

_PARAMETERS = (
    *(
        "mass",
        "mass_base",
        "damping",
        "stiffness",
        "base",
        "direct",
        "frequency",
        "normal_frequency",
    ),
    *("phase", "load", "preload", "amplitude", "direction"),
    *("bristle_rate", "drag", "reversed_at", "stretch"),
)
_PLACE = {name: index for index, name in enumerate(_PARAMETERS)}
_LAST: dict[Form, str] = {"coulomb": "direction", "path": "stretch", "state": "drag"}


@dataclass(frozen=True)
class SlidingRun:
    """States `samples` (n, 4): position, velocity, resonator displacement and velocity.

    `reversals`, `steps` and `evaluations` of the right hand side count over the run, 0 where a
    method does not report them.
    """

    samples: Array
    reversals: int = 0
    steps: int = 0
    evaluations: int = 0


def simulate_sliding(
    device: Device,
    inputs: HeldInputs,
    times: Array,
    *,
    tolerance: float,
    bristle: Literal["path", "state"] = "path",
    start: float | None = None,
) -> SlidingRun:
    """Follow a moving slider to the stop of `inputs` (s), theta = psi = 0 at their start.

    The initial state is that at `start` (s), by default the start of the inputs. `times` (s, shape
    (n,)) ascend from there. `tolerance` is the relative one of a Taylor step. With LuGre friction
    `bristle` says whether its deflection is taken from the path or integrated. The first call with
    a `tolerance` compiles. Raises ValueError for what is not covered; RuntimeError when heyoka
    fails; ModuleNotFoundError without heyoka.
    """
    if device.normal_amplitude > device.normal_preload:
        raise ValueError("normal_amplitude above normal_preload: the contact lifts")
    if device.initial_velocity == 0.0 or device.fidelity != 2 or device.resonator_mass == 0.0:
        raise ValueError("only full devices with initial_velocity not 0 are covered")
    form: Form = "coulomb" if device.friction_law == 0 else bristle
    run = _compiled(form, tolerance)
    integrator, counter = run.integrator, run.counter
    _set(integrator, device, inputs)
    counter.reversals = 0
    integrator.time = 0.0 if start is None else start - inputs.start
    integrator.reset_cooldowns()
    state = [0.0, device.initial_velocity]
    state += [device.initial_resonator_displacement, device.initial_resonator_velocity]
    stretch = device.bristle_stiffness * device.initial_bristle_deflection
    stretch /= device.friction_coefficient
    if form == "path":
        integrator.pars[_PLACE["stretch"]] = stretch
    integrator.state[:] = [*state, stretch] if form == "state" else state
    grid = np.union1d(times - inputs.start, [integrator.time, inputs.stop - inputs.start])
    outcome, *_, steps, _, states = integrator.propagate_grid(grid.tolist())
    if "time_limit" not in str(outcome):
        raise RuntimeError(f"heyoka ended after {steps} steps with {outcome}")
    samples = np.array(states)[np.searchsorted(grid, times - inputs.start), :4]
    samples[:, 0] += device.initial_position
    return SlidingRun(samples, counter.reversals, steps)


class _Counter:
    reversals = 0


@dataclass(frozen=True)
class _Compiled:
    integrator: Any
    counter: _Counter


@cache
def _compiled(form: Form, tolerance: float) -> _Compiled:
    try:
        hy = importlib.import_module("heyoka")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "the Taylor reference needs heyoka: pip install 'slider-resonator[taylor]'"
        ) from error
    x, v, y, u, z = hy.make_vars("x", "v", "y", "u", "z")
    par = {name: hy.par[index] for name, index in _PLACE.items()}
    angle = par["frequency"] * hy.time
    normal = par["preload"] + par["amplitude"] * hy.sin(
        par["normal_frequency"] * hy.time + par["phase"]
    )
    rate = par["bristle_rate"]
    if form == "coulomb":
        share = par["direction"]
    else:
        stretch = z
        if form == "path":
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
    if form == "state":
        system.append((z, rate * v * (1.0 - par["direction"] * z)))
    counter = _Counter()

    def reverse(integrator: Any, sign: int) -> bool:
        pars = integrator.pars
        direction, position = pars[_PLACE["direction"]], integrator.state[0]
        if form == "path":
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
        pars=[0.0] * (_PLACE[_LAST[form]] + 1),
        tol=tolerance,
        t_events=[event],
    )
    # A copy made by heyoka would keep its own callback, so the counter is found by the original.
    return _Compiled(integrator, counter)


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
