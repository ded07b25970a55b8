"""The outputs of the interface, each from the motion under the present inputs and the moment."""

from collections.abc import Callable
from math import remainder, tau

from .averaged import Averaged
from .contact import STICK
from .moment import Moment
from .prediction import prediction, turns_of_load
from .resolved import Resolved

Motion = Resolved | Averaged
"""A device under held inputs; `Leaping` is one that is resolved."""


def _predicted(motion: Motion, now: Moment, blocked: bool) -> tuple[float, bool]:
    device, inputs = motion.system.device, motion.system.inputs
    ratio, turns = inputs.frequency_ratio, turns_of_load(device, inputs.frequency_ratio)
    lead = remainder(now.psi - ratio * now.theta, tau / turns) if turns else 0.0
    # Without the rounding errors of phases it is the same from one period to the next.
    return prediction(device, inputs, round(lead, 12), blocked)


OUTPUTS: dict[str, Callable[[Motion, Moment], float]] = {
    "position": lambda motion, now: now.position,
    "velocity": lambda motion, now: now.velocity,
    "mean_velocity": lambda motion, now: now.mean(now.mean_velocity, now.travel, now.velocity),
    "resonator_displacement": lambda motion, now: motion.system.resonator(now)[0],
    "resonator_velocity": lambda motion, now: motion.system.resonator(now)[1],
    "normal_force": lambda motion, now: motion.system.normal_load.at(now.psi + motion.system.phase),
    "friction_force": lambda motion, now: motion.friction_force(now),
    "contact_mode": lambda motion, now: float(motion.mode(now)),
    "reversals": lambda motion, now: float(now.reversals),
    "stick_fraction": lambda motion, now: now.mean(
        now.stick_fraction, now.sticking, float(motion.mode(now) == STICK)
    ),
    "last_event_time": lambda motion, now: now.last_event_time,
    "steady_velocity": lambda motion, now: _predicted(motion, now, False)[0],
    "blocking_force": lambda motion, now: _predicted(motion, now, True)[0],
    "prediction_valid": lambda motion, now: float(
        all(_predicted(motion, now, blocked)[1] for blocked in (False, True))
    ),
    "friction_power": lambda motion, now: motion.friction_power(now),
    "slow_motion_error": lambda motion, now: motion.slow_motion_error(now),
}
