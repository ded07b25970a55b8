"""The outputs of the interface, each from the present moment and the present inputs."""

from collections.abc import Callable
from math import remainder, sin, tau
from typing import NamedTuple

from .averaged import Averaged
from .contact import STICK
from .moment import Moment
from .prediction import Prediction, prediction, turns_of_load
from .resolved import Resolved

LEAD_DIGITS = 12
"""Decimals to which leads of the normal load [rad] are rounded: without the rounding errors of
phases, predictions are the same from one period to the next."""


class View(NamedTuple):
    """What outputs are read from."""

    motion: Resolved | Averaged
    now: Moment
    last_event_time: float


def _normal_force(view: View) -> float:
    device, chi = view.motion.system.device, view.now.psi + view.motion.system.phase
    return max(0.0, device.normal_preload + device.normal_amplitude * sin(chi))


def _stick_fraction(view: View) -> float:
    now, sticks = view.now, view.motion.mode(view.now) == STICK
    return min(now.mean(now.stick_fraction, now.sticking, float(sticks)), 1.0)


def _theory(view: View) -> Prediction:
    device, inputs = view.motion.system.device, view.motion.system.inputs
    ratio = inputs.frequency_ratio
    turns = turns_of_load(device, ratio)
    lead = remainder(view.now.psi - ratio * view.now.theta, tau / turns) if turns else 0.0
    return prediction(device, inputs, round(lead, LEAD_DIGITS))


OUTPUTS: dict[str, Callable[[View], float]] = {
    "position": lambda view: view.now.position,
    "velocity": lambda view: view.now.velocity,
    "mean_velocity": lambda view: view.now.mean(
        view.now.mean_velocity, view.now.travel, view.now.velocity
    ),
    "resonator_displacement": lambda view: view.motion.resonator(view.now)[0],
    "resonator_velocity": lambda view: view.motion.resonator(view.now)[1],
    "normal_force": _normal_force,
    "friction_force": lambda view: view.motion.friction_force(view.now),
    "contact_mode": lambda view: float(view.motion.mode(view.now)),
    "reversals": lambda view: float(view.now.reversals),
    "stick_fraction": _stick_fraction,
    "last_event_time": lambda view: view.last_event_time,
    "steady_velocity": lambda view: _theory(view).steady_velocity,
    "blocking_force": lambda view: _theory(view).blocking_force,
    "prediction_valid": lambda view: float(_theory(view).valid),
    "friction_power": lambda view: view.motion.friction_power(view.now),
    "slow_motion_error": lambda view: view.motion.slow_motion_error(view.now),
}
