"""Leaving a stick: the slider starts with neither velocity nor acceleration.

The velocity then grows with the second power of time, v >= jerk t^2 / 2 - B t^3 / 6 while B bounds
its third derivative, and is positive up to t = 3 jerk / B. The search for the next zero can start
there, past the zero that the motion starts from.
"""

from __future__ import annotations

from math import cos, hypot, sin

from .motion import State
from .plant import Plant


def departure_time(plant: Plant, sign: int, state: State, theta: float, chi: float) -> float:
    """A time [s] up to which a slider released in direction `sign` is guaranteed to move on.

    0 if there is no guarantee.
    """
    w, q = plant.drive_frequency, plant.normal_frequency
    drive, amplitude = plant.drive, sign * plant.friction_amplitude
    push = complex(sin(theta), -cos(theta)) * drive
    jerk = -w * push.imag - q * amplitude * cos(chi) / plant.total_mass
    bound = abs(drive) * w * w + abs(amplitude) * q * q / plant.total_mass
    horizon = 1.0 / max(w, abs(q), plant.slip.frequency)
    if plant.mass_fraction:
        decay, stiffness = plant.slip.decay, plant.slip.stiffness
        frequency = plant.slip.frequency
        resisting = sign * plant.friction_preload + amplitude * sin(chi) + plant.load
        forcing = plant.relative_drive * sin(theta) + resisting / plant.slider_mass
        forcing_rate = (
            plant.relative_drive * w * cos(theta) + amplitude * q * cos(chi) / plant.slider_mass
        )
        forcing_bound = (
            abs(plant.relative_drive) * w * w + abs(amplitude) * q * q / plant.slider_mass
        )
        second = forcing - 2.0 * decay * state.rate - stiffness * state.displacement
        third = forcing_rate - 2.0 * decay * second - stiffness * state.rate
        energy = hypot(third, frequency * second) + horizon * forcing_bound
        jerk -= plant.mass_fraction * third
        bound += plant.mass_fraction * ((2.0 * decay + frequency) * energy + forcing_bound)
    jerk *= sign
    if jerk <= 0.0:
        return 0.0
    return horizon if 3.0 * jerk >= bound * horizon else 3.0 * jerk / bound
