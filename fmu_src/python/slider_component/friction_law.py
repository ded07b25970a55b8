"""The interface of a friction law: a table of functions.

A new law is a module with its table, and an entry in `friction_laws`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from .averaged_friction import AveragedFriction
from .device import Device
from .held import Held
from .leg import Leg
from .moment import Moment


class Follow(Protocol):
    """See `FrictionLaw.follow`."""

    def __call__(
        self, held: Held, now: Moment, longest: float, switching: float, departs: bool
    ) -> Leg:
        """The leg that goes on from `now`."""
        ...


@dataclass(frozen=True, slots=True)
class FrictionLaw:
    """One friction law.

    `check(device)` raises Refusal for a device for which the law is not defined.

    `first_bristle(held)` is the friction of the bristle at the start, per unit load.

    `mode(held, moment)` is the contact mode under the held inputs.

    `force(held, moment, mode)` is the friction force [N] on the slider in contact mode `mode`,
    positive against +X.

    `follow(held, now, longest, switching, departs)` is the leg that goes on from `now`, in the
    contact mode of `now`, for up to `longest` [s]. The contact lifts or touches down after
    `switching` [s]; `departs` is True for a slider that starts from rest, not at a reversal.

    `succeed(held, leg, now, switches)` changes from the end of a finished leg to the next contact
    mode; `switches` is True where the contact lifts or touches down there.
    """

    check: Callable[[Device], None]
    first_bristle: Callable[[Held], float]
    mode: Callable[[Held, Moment], int]
    force: Callable[[Held, Moment, int], float]
    follow: Follow
    succeed: Callable[[Held, Leg, Moment, bool], None]
    averaged: AveragedFriction
