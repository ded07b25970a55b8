"""The LuGre equations in heyoka's terms: one compiled system per way to treat the bristle.

Time is the drive angle, forces are in units of a characteristic force, and the contact slides in
one direction. All numbers are runtime parameters.
"""

from __future__ import annotations

import importlib
from functools import cache
from typing import Any, Literal

from slider_resonator.references.resolved.lugre_equations import LugreEquations

Bristle = Literal["path", "state"]
"""Whether the bristle follows from the path since the start of a step, or is a state."""

HELD = slice(13)
"""Parameters that stay while inputs and contact do, those of ``lugre_parameters``."""

DRIVE_AND_NORMAL_ANGLE = slice(13, 15)
"""Parameters: theta and the angle of the normal load at the start of a step, rad."""

DIRECTION = 15
"""Parameter: the sign of the velocity."""

STRETCH_AND_SHORTFALL = slice(16, 18)
"""Parameters, for the bristle from the path, at the start of a step: its stretch, and how far that
is from ``DIRECTION``, the stretch of steady sliding."""


@cache
def lugre_integrator(bristle: Bristle, tolerance: float) -> Any:
    """Return the Taylor integrator of the scaled equations, compiled once.

    The state is path, velocity, Y, Y' and, with the bristle as a state, its stretch; the places
    of the parameters are above. Raises ModuleNotFoundError when heyoka is not installed.
    """
    try:
        heyoka = importlib.import_module("heyoka")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "the Taylor reference needs heyoka: pip install 'slider-resonator[referee]'"
        ) from error
    path, velocity, displacement, resonator_velocity, stretch = heyoka.make_vars(
        "x", "v", "y", "u", "w"
    )
    (
        damping,
        stiffness,
        sine,
        cosine,
        load,
        friction,
        normal,
        base,
        damping_rate,
        stiffness_rate,
        path_rate,
        path_damping,
        ratio,
        theta,
        angle,
        direction,
        first_stretch,
        shortfall,
    ) = (heyoka.par[index] for index in range(18))
    drive_angle = theta + heyoka.time
    if bristle == "path":
        # The path starts at zero, where the bracket vanishes exactly: in presliding no difference
        # of numbers near 1 takes digits from the small stretch.
        decay = heyoka.exp(-path_rate * direction * path)
        stretch = first_stretch + shortfall * (1.0 - decay)
        missing = shortfall * decay
    else:
        missing = direction - stretch
    # |v| is written as direction times v, analytic up to and through the reversal.
    grip = stretch + path_damping * direction * velocity * missing
    acceleration = (
        damping * resonator_velocity
        + stiffness * displacement
        + sine * heyoka.sin(drive_angle)
        + cosine * heyoka.cos(drive_angle)
        - load
        - grip * (friction + normal * heyoka.sin(angle + ratio * heyoka.time))
    )
    system = [
        (path, velocity),
        (velocity, acceleration),
        (displacement, resonator_velocity),
        (
            resonator_velocity,
            base * heyoka.sin(drive_angle)
            - damping_rate * resonator_velocity
            - stiffness_rate * displacement
            - acceleration,
        ),
    ]
    if bristle == "state":
        system.append((stretch, path_rate * direction * velocity * missing))
    return heyoka.taylor_adaptive(system, [0.0] * len(system), tol=tolerance)


def lugre_parameters(
    lugre: LugreEquations, load: float, ratio: float, force: float, lifted: bool
) -> list[float]:
    """Return the parameters of the scaled equations that a step does not change, ``HELD``.

    ``load`` and the characteristic ``force`` are in N. While ``lifted`` there is no friction.
    """
    equations = lugre.equations
    rate = equations.drive_frequency
    coupling = 1.0 / (equations.inertia * rate)
    speed = force * coupling
    contact = 0.0 if lifted else 1.0 / force
    return [
        coupling * equations.coupling_damping,
        coupling * equations.coupling_stiffness / rate,
        equations.force_sine / force,
        equations.force_cosine / force,
        load / force,
        contact * equations.friction_mean,
        contact * equations.friction_amplitude,
        equations.base_acceleration * equations.inertia / force,
        equations.damping_rate / rate,
        equations.stiffness_rate / rate**2,
        lugre.path_rate * speed / rate,
        lugre.path_damping * speed,
        ratio,
    ]
