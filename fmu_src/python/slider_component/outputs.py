"""The outputs of the interface, each from the present moment and the present inputs."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import remainder, sin, tau
from typing import NamedTuple

from .averaged import Averaged, averaged
from .contact import STICK
from .device import Device, Inputs
from .fast_vibration import steady_swing
from .law import Law
from .moment import Moment
from .vibrating_load import EXACT, turns_to_repeat

LEAD_DIGITS = 9
"""Decimals to which psi - n theta [rad] is rounded for the averaged outputs: the rounding errors of
the phases then do not make them flicker."""


class View(NamedTuple):
    """What outputs are read from; `mode` is the contact mode under the present inputs."""

    device: Device
    inputs: Inputs
    law: Law
    moment: Moment
    mode: int
    last_event_time: float


def _swing(view: View) -> tuple[float, float]:
    """Displacement [m] and velocity [m/s] of the resonator."""
    plant, state = view.law.held.plant, view.moment.state
    if plant.resonator_amplitude is None:
        return state.displacement, state.rate
    return steady_swing(plant.resonator_amplitude, view.moment.theta, plant.drive_frequency)


def _normal_force(view: View) -> float:
    chi = view.moment.psi + view.inputs.phase
    device = view.device
    return max(0.0, device.normal_preload + device.normal_amplitude * sin(chi))


def _theory(view: View) -> Averaged:
    ratio = view.inputs.frequency_ratio
    repeats = turns_to_repeat(view.device, ratio, EXACT) is not None
    lead = remainder(view.moment.psi - ratio * view.moment.theta, tau) if repeats else 0.0
    return _averaged(view.device, view.inputs, round(lead, LEAD_DIGITS))


_averaged = lru_cache(maxsize=8)(averaged)

OUTPUTS: dict[str, Callable[[View], float]] = {
    "position": lambda view: view.moment.position,
    "velocity": lambda view: view.moment.state.velocity,
    "mean_velocity": lambda view: view.moment.means.present_mean_velocity(
        view.moment.state.velocity
    ),
    "resonator_displacement": lambda view: _swing(view)[0],
    "resonator_velocity": lambda view: _swing(view)[1],
    "normal_force": _normal_force,
    "friction_force": lambda view: view.law.friction_force(view.moment, view.mode),
    "contact_mode": lambda view: float(view.mode),
    "reversals": lambda view: float(view.moment.counts.reversals),
    "stick_fraction": lambda view: view.moment.means.present_stick_fraction(view.mode == STICK),
    "last_event_time": lambda view: view.last_event_time,
    "steady_velocity": lambda view: _theory(view).steady_velocity,
    "blocking_force": lambda view: _theory(view).blocking_force,
    "prediction_valid": lambda view: float(_theory(view).valid),
}
