"""Amplitudes of sliding and flight as a sum of exponentials: the fast form, for most devices.

The particular solutions at drive and normal frequency are split off from the free oscillation. That
loses digits near resonance, near critical damping and for slow normal loads: there `split_of` gives
None, and the forms of `oscillator` serve, which stay regular.
"""

from __future__ import annotations

from dataclasses import dataclass

from .oscillator import Oscillator

SLOW = 0.02
"""Share of the drive frequency below which an oscillator or a forcing counts as slow: its steady
response would be far larger than the response between two reversals."""

RESONANT = 0.02
"""Relative distance of forcing frequency and eigenvalue below which the particular solution grows
too large."""


@dataclass(frozen=True, slots=True)
class Split:
    """Complex amplitudes per unit exp(i theta_0) and, for s = 1, per unit exp(i chi_0).

    Displacement of the resonator (`resonator_*`) and velocity of the slider (`velocity_*`);
    `velocity_free` is that per displacement of the free resonator [1/s], `compliance` the
    displacement per constant force [m/N]. `drive`, `normal` and `free` are the rates z [1/s] of the
    exponentials, `squares` their |z|^2; `free` is 0 where the resonator is not followed.
    """

    drive: complex
    normal: complex
    free: complex
    squares: tuple[float, float, float]
    compliance: float
    velocity_free: complex
    resonator_drive: complex
    velocity_drive: complex
    resonator_normal: complex
    velocity_normal: complex


def split_of(
    oscillator: Oscillator | None,
    frequencies: tuple[float, float],
    fraction: float,
    drive: complex,
    relative_drive: float,
    friction: tuple[float, float],
    slider_compliance: float,
) -> Split | None:
    """The amplitudes, or None where splitting would lose digits.

    For a resonator of the mass `fraction` under drive and normal load of these `frequencies`
    [rad/s]; None where it is not followed. `drive` and `relative_drive` as in `device.System`;
    `friction` is the amplitude of friction per slider mass and per total mass [m/s^2].
    """
    w, q = frequencies
    if 0.0 < abs(q) < SLOW * w:
        return None
    free, resonator_drive, resonator_normal, compliance = 0j, 0j, 0j, 0.0
    if oscillator is not None:
        free = oscillator.eigenvalues[0]
        soft = oscillator.frequency < SLOW * max(w, abs(q))
        if soft or not oscillator.is_oscillatory or _resonates(free, w) or _resonates(free, q):
            return None
        resonator_drive = relative_drive * oscillator.transfer(w)
        resonator_normal = friction[0] * oscillator.transfer(q)
        compliance = slider_compliance / oscillator.stiffness
    velocity_drive = (drive + fraction * w * w * resonator_drive) / complex(0.0, w)
    velocity_normal = 0j
    if q != 0.0:
        push = fraction * q * q * resonator_normal - friction[1]
        velocity_normal = push / complex(0.0, q)
    turn = complex(0.0, -1.0)
    return Split(
        complex(0.0, w),
        complex(0.0, q),
        free,
        (w * w, q * q, abs(free) ** 2),
        compliance,
        -fraction * free,
        turn * resonator_drive,
        turn * velocity_drive,
        turn * resonator_normal,
        turn * velocity_normal,
    )


def _resonates(eigenvalue: complex, frequency: float) -> bool:
    return abs(eigenvalue - complex(0.0, abs(frequency))) < RESONANT * abs(eigenvalue)
