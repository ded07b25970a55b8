"""What averaged motion of second order carries on from one step to the next."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

MAX_LEADS = 4
"""Leads of the normal load up to which each new one gets a table of its own."""

MAX_TUNINGS = 4
"""Changes of parameters up to which the orbits are tabulated anew."""


class Stage(IntEnum):
    """How a step was made last: by averages of first order, resolved, or along held orbits."""

    AVERAGED = 0
    RESOLVED = 1
    ON_ORBIT = 2


class OrbitValues(NamedTuple):
    """What a held orbit depends on and what may change from one step to the next.

    Input phase [rad], load [N], `waves` of the normal load in a turn of the drive, and the tunable
    parameters.
    """

    phase: float = 0.0
    load: float = 0.0
    waves: float = 0.0
    preload: float = 0.0
    amplitude: float = 0.0
    coefficient: float = 0.0
    base: float = 0.0
    frequency: float = 0.0
    force: float = 0.0


class VisitedLeads(NamedTuple):
    """Leads [rad] that were visited; `visits` is MAX_LEADS + 1 once there were more."""

    visits: int = 0
    first: float = 0.0
    second: float = 0.0
    third: float = 0.0
    fourth: float = 0.0

    def visited(self, lead: float) -> VisitedLeads:
        """The same after a visit."""
        known = self[1 : 1 + min(self.visits, MAX_LEADS)]
        if lead in known or self.visits > MAX_LEADS:
            return self
        if self.visits == MAX_LEADS:
            return self._replace(visits=self.visits + 1)
        leads = (*known, lead, *([0.0] * (MAX_LEADS - 1 - len(known))))
        return VisitedLeads(self.visits + 1, *leads)


class Swing(NamedTuple):
    """Displacement [m] and velocity [m/s] of the resonator's own swing."""

    displacement: float = 0.0
    rate: float = 0.0


class OrbitState(NamedTuple):
    """The state beside the moment.

    `to_go` is the drive angle [rad] that is still to be resolved. On an orbit: slow velocity V
    [m/s], slow centre [m] and lead [rad] of the normal load, and what is left of the resonator's
    own `swing`, by which it differs from the orbit. The step was made `under` these values;
    `tunings` counts, up to MAX_TUNINGS, how often a parameter changed the orbits. `grazed` says
    that the slider went so fast that it did not turn back.
    """

    stage: int = Stage.AVERAGED
    to_go: float = 0.0
    velocity: float = 0.0
    centre: float = 0.0
    lead: float = 0.0
    swing: Swing = Swing()
    under: OrbitValues = OrbitValues()
    leads: VisitedLeads = VisitedLeads()
    tunings: int = 0
    grazed: bool = False


NO_ORBIT = OrbitState()
"""The state beside a moment that serves no averages of second order."""
