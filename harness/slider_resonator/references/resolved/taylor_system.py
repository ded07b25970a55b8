"""The equations of motion in heyoka's terms, for both friction laws and either form of bristle.

Time is the drive angle, forces are in units of a characteristic force, and the contact slides in
one direction. All numbers are runtime parameters, so that one compiled system serves every device.
"""

from __future__ import annotations

import importlib
from functools import cache
from typing import Any, Literal

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.equations import Equations

Friction = Literal["coulomb", "path", "state"]
"""Coulomb, or LuGre with the bristle from the path since the start of a step or as a state."""

ROUNDING = 1e-18
"""Tolerance of a Taylor step in the scaled variables, below what double precision resolves."""
ROUNDING_OF_A_SUM = 1e-15

HELD = slice(12)
"""Parameters that stay while inputs and contact do, those of ``held_parameters``."""
DRIVE_AND_NORMAL_ANGLE = slice(12, 14)
"""Parameters: theta and the angle of the normal load at the start of a step, rad."""
DIRECTION = 14
"""Parameter: the sign of the velocity."""
BRISTLE = slice(15, 17)
"""Parameters of LuGre friction: path rate and path damping, scaled."""
LOAD_AND_RATIO_RATES = slice(19, 21)
"""Parameters of a system with ``rates``: those of load and, halved, of the ratio, scaled."""
STRETCH_AND_SHORTFALL = slice(17, 19)
"""Parameters, for the bristle from the path, at the start of a step: its stretch, and how far that
is from ``DIRECTION``, the stretch of steady sliding."""


@cache
def taylor_integrator(friction: Friction, tolerance: float, *, rates: bool) -> Any:
    """Return the Taylor integrator of the scaled equations, compiled once.

    With ``rates`` load and frequency ratio are straight lines in time.

    The state is path, velocity, Y, Y' and, with the bristle as a state, its stretch; the places
    of the parameters are above. Raises ModuleNotFoundError when heyoka is not installed.
    """
    try:
        heyoka = importlib.import_module("heyoka")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "the Taylor reference needs heyoka: pip install 'slider-resonator[taylor]'"
        ) from error
    path, velocity, displacement, resonator_velocity, stretch = heyoka.make_vars(
        "x", "v", "y", "u", "w"
    )
    held = [heyoka.par[index] for index in range(HELD.stop)]
    slides, damping, stiffness, sine, cosine, load, mean, amplitude, *resonator, ratio = held
    base, damping_rate, stiffness_rate = resonator
    theta, angle, direction, path_rate, path_damping, first_stretch, shortfall = (
        heyoka.par[index] for index in range(HELD.stop, STRETCH_AND_SHORTFALL.stop)
    )
    if friction == "coulomb":
        grip = direction
    else:
        if friction == "path":
            # The path starts at zero, where the bracket vanishes exactly: in presliding no
            # difference of numbers near 1 takes digits from the small stretch.
            decay = heyoka.exp(-path_rate * direction * path)
            stretch = first_stretch + shortfall * (1.0 - decay)
            missing = shortfall * decay
        else:
            missing = direction - stretch
        # |v| is written as direction times v, analytic up to and through the reversal.
        grip = stretch + path_damping * direction * velocity * missing
    normal_angle = angle + ratio * heyoka.time
    if rates:
        load_rate, half_chirp = (
            heyoka.par[index]
            for index in range(LOAD_AND_RATIO_RATES.start, LOAD_AND_RATIO_RATES.stop)
        )
        load = load + load_rate * heyoka.time
        normal_angle = angle + (ratio + half_chirp * heyoka.time) * heyoka.time
    drive_angle = theta + heyoka.time
    acceleration = slides * (
        damping * resonator_velocity
        + stiffness * displacement
        + sine * heyoka.sin(drive_angle)
        + cosine * heyoka.cos(drive_angle)
        - load
        - grip * (mean + amplitude * heyoka.sin(normal_angle))
    )
    resonator_acceleration = (
        base * heyoka.sin(drive_angle)
        - damping_rate * resonator_velocity
        - stiffness_rate * displacement
        - acceleration
    )
    system = [
        (path, velocity),
        (velocity, acceleration),
        (displacement, resonator_velocity),
        (resonator_velocity, resonator_acceleration),
    ]
    if friction == "state":
        system.append((stretch, path_rate * direction * velocity * missing))
    return heyoka.taylor_adaptive(system, [0.0] * len(system), tol=tolerance)


def held_parameters(
    equations: Equations, load: float, ratio: float, force: float, mode: int | None
) -> list[float]:
    """Return the parameters of the scaled equations that a step does not change, ``HELD``.

    ``load`` and the characteristic ``force`` are in N. A stick holds the slider, an open contact
    has no friction.
    """
    rate = equations.drive_frequency
    coupling = 1.0 / (equations.inertia * rate)
    contact = 0.0 if mode == LIFTED else 1.0 / force
    return [
        float(mode != STICK),
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
        ratio,
    ]


def scales_of(equations: Equations, load: float) -> tuple[float, Array]:
    """Return the characteristic force in N, and the units of path, velocity, Y and Y', SI."""
    force = equations.force_scale(load) or 1.0
    velocity = force / (equations.inertia * equations.drive_frequency)
    return force, np.array([velocity / equations.drive_frequency, velocity] * 2)


def series_values(times: Array, coefficients: Array) -> Array:
    """Return the values, shape (n, k), of k Taylor series (k, order + 1) at n times."""
    return np.asarray(np.polynomial.polynomial.polyval(times, coefficients.T), dtype=np.float64).T


def rate_parameters(
    equations: Equations, load_rate: float, ratio_rate: float, force: float
) -> list[float]:
    """Return the parameters ``LOAD_AND_RATIO_RATES`` of rates in N/s and 1/s.

    ``force`` (N) is characteristic.
    """
    frequency = equations.drive_frequency
    return [load_rate / (frequency * force), 0.5 * ratio_rate / frequency]
