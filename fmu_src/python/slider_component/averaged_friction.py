"""The interface of a friction law to averaged motion: means over a turn of the drive.

The slider moves with V - v_q cos(tau), so that it slides forward while tau is in (Theta, 2 pi -
Theta) with Theta = arccos(V / v_q).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from .bristle import Bristle
from .vibrating_load import VibratingLoad


@dataclass(frozen=True, slots=True)
class FastMotion:
    """Fast velocity amplitude v_q [m/s] and drive frequency [rad/s]."""

    velocity: float
    frequency: float


class FrictionMeans(NamedTuple):
    """Means over a turn of tau of the friction per unit load, times 1, sin(n tau), cos(n tau)."""

    plain: float
    sine: float
    cosine: float


@dataclass(frozen=True, slots=True)
class AveragedFriction:
    """The averages of one friction law; `turning` is Theta [rad], in [0, pi].

    `is_expensive`: each mean costs a quadrature, so that a table of means pays.

    `grip(bristle, amplitude, frequency)` is the largest friction per unit load that resists a
    vibration of this amplitude [m] and frequency [rad/s] about rest.

    `drag(bristle, fast_velocity)` is the largest friction per unit load beyond mu at a fast
    velocity [m/s]; above mu, mean friction may rise with Theta.

    `mean(bristle, fast, load, turning)` is the mean friction [N] of one face.

    `means(bristle, fast, n, turning)` are the parts of that under a load N0 + dN sin(n tau +
    delta), n not 0: per face it is N0 plain + dN (cos(delta) sine + sin(delta) cosine).
    """

    is_expensive: bool
    grip: Callable[[Bristle, float, float], float]
    drag: Callable[[Bristle, float], float]
    mean: Callable[[Bristle, FastMotion, VibratingLoad, float], float]
    means: Callable[[Bristle, FastMotion, int, float], FrictionMeans]
