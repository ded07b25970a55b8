"""The outputs of the interface, each from the present moment and the present inputs."""

from __future__ import annotations

from collections.abc import Callable
from math import remainder, sin, tau
from typing import NamedTuple

from .averaged import Averaged
from .contact import STICK
from .device import Device, Inputs
from .law import Law
from .moment import Moment
from .prediction import prediction_of
from .slow_phase import rounded_lead
from .vibrating_load import EXACT, turns_to_repeat


class View(NamedTuple):
    """What outputs are read from; `mode` is the contact mode under the present inputs."""

    device: Device
    inputs: Inputs
    law: Law
    moment: Moment
    mode: int
    last_event_time: float


def _normal_force(view: View) -> float:
    chi = view.moment.psi + view.inputs.phase
    device = view.device
    return max(0.0, device.normal_preload + device.normal_amplitude * sin(chi))


def _theory(view: View) -> Averaged:
    ratio = view.inputs.frequency_ratio
    repeats = turns_to_repeat(view.device, ratio, EXACT) is not None
    lead = remainder(view.moment.psi - ratio * view.moment.theta, tau) if repeats else 0.0
    return prediction_of(view.device, view.inputs, rounded_lead(lead))


OUTPUTS: dict[str, Callable[[View], float]] = {
    "position": lambda view: view.moment.position,
    "velocity": lambda view: view.moment.state.velocity,
    "mean_velocity": lambda view: view.moment.means.present_mean_velocity(
        view.moment.state.velocity
    ),
    "resonator_displacement": lambda view: view.law.swing(view.moment)[0],
    "resonator_velocity": lambda view: view.law.swing(view.moment)[1],
    "normal_force": _normal_force,
    "friction_force": lambda view: view.law.friction_force(view.moment, view.mode),
    "contact_mode": lambda view: float(view.mode),
    "reversals": lambda view: float(view.moment.counts.reversals),
    "stick_fraction": lambda view: view.moment.means.present_stick_fraction(view.mode == STICK),
    "last_event_time": lambda view: view.last_event_time,
    "steady_velocity": lambda view: _theory(view).steady_velocity,
    "blocking_force": lambda view: _theory(view).blocking_force,
    "prediction_valid": lambda view: float(_theory(view).valid),
    "slow_motion_error": lambda view: view.law.slow_motion_error(view.moment),
}
