"""The equations of a periodic motion: its state repeats, and mean velocity or load are given.

All numbers are in the scales of the period map. The unknowns are the states at the section, which
are W, displacement and velocity of the resonator and under LuGre friction the friction of the
bristle; after them the load.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, inf
from typing import NamedTuple

from .linear_system import Matrix, Vector, solve_linear
from .moment import Moment
from .motion import State
from .period_map import PeriodMap

DIFFERENCE = 1e-6
"""Step of a Jacobian in the scales of the unknowns."""


MAX_UNKNOWN = 1e4
"""Largest unknown, in its scale, that is mapped: beyond, no orbit is near, and numbers overflow."""


class Trial(NamedTuple):
    """What unknowns lead to.

    `values` are by how much the states change in a period, and then the mean velocity; the moments
    are those at both ends.
    """

    values: Vector
    section: Moment
    after: Moment


@dataclass(slots=True)
class OrbitEquations:
    """The equations at drive phase `theta` [rad] of the section.

    `given` is the mean velocity, or where `loaded` the load. `maps` counts.
    """

    map: PeriodMap
    lead: float
    theta: float = 0.0
    given: float = 0.0
    loaded: bool = False
    maps: int = 0

    def section(self, unknowns: Vector) -> Moment:
        """The moment at the section."""
        scales, plant = self.map, self.map.held.plant
        rate = scales.swing * plant.drive_frequency * unknowns[2]
        velocity = (
            scales.speed * unknowns[0]
            - plant.mass_fraction * rate
            - scales.fast.pair_velocity * cos(self.theta)
        )
        coefficient = scales.held.bristle.coefficient
        bristle = coefficient * unknowns[3] if scales.states > 3 else 0.0
        state = State(velocity, scales.swing * unknowns[1], rate)
        return scales.enter(self.lead, self.theta, state, bristle)

    def unknowns(self, state: State, bristle: float, load: float) -> Vector:
        """The unknowns that a state and a bristle at the section and a load [N] stand for."""
        scales = self.map
        found = [
            scales.momentum_velocity(state, self.theta) / scales.speed,
            state.displacement / scales.swing,
            state.rate / (scales.swing * scales.held.plant.drive_frequency),
        ]
        if scales.states > 3:
            found.append(bristle / scales.held.bristle.coefficient)
        return [*found, load / scales.force]

    def attempt(self, unknowns: Vector) -> Trial | None:
        """Map the period. None where that fails."""
        scales, states = self.map, self.map.states
        if not all(abs(unknown) <= MAX_UNKNOWN for unknown in unknowns):
            return None
        load = scales.force * unknowns[states]
        section = self.section(unknowns)
        self.maps += 1
        after = scales.advance(self.lead, load, section, scales.period)
        if after is None:
            return None
        reached = self.unknowns(after.state, after.bristle, load)
        values = [reached[i] - unknowns[i] for i in range(states)]
        return Trial([*values, after.position / (scales.period * scales.speed)], section, after)

    def jacobian(self, unknowns: Vector, trial: Trial) -> Matrix | None:
        """The Jacobian of the values by differences, from the trial of `unknowns` on."""
        columns = []
        for j in range(len(unknowns)):
            moved = list(unknowns)
            moved[j] += DIFFERENCE
            other = self.attempt(moved)
            if other is None:
                return None
            step = moved[j] - unknowns[j]
            columns.append(
                [(a - b) / step for a, b in zip(other.values, trial.values, strict=True)]
            )
        return [list(row) for row in zip(*columns, strict=True)]

    def newton_step(self, jacobian: Matrix, values: Vector, unknowns: Vector) -> Vector | None:
        """The step of Newton's method that leads from `values` to what is asked for.

        None where the Jacobian is singular.
        """
        right = [-value for value in values]
        right[-1] += self.given
        if not self.loaded:
            return solve_linear(jacobian, right)
        right[-1] = self.given - unknowns[-1]
        only_load = [0.0] * (len(right) - 1) + [1.0]
        return solve_linear([*jacobian[:-1], only_load], right)


def largest(step: Vector | None) -> float:
    """The largest entry of a step, infinite where there is none."""
    return inf if step is None else max(map(abs, step))
