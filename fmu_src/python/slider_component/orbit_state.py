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

    Input phase [rad], load [N], frequency ratio, `waves` of the normal load in a turn of the drive,
    and the tunable parameters.
    """

    phase: float = 0.0
    load: float = 0.0
    ratio: float = 0.0
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


class PaidTables(NamedTuple):
    """Tables that are paid for.

    The last `curves` ones at one lead, of these waves in a turn and leads [rad], and whether the
    series over all leads is, of `series_waves`.
    """

    curves: int = 0
    first_waves: float = 0.0
    second_waves: float = 0.0
    third_waves: float = 0.0
    fourth_waves: float = 0.0
    first_lead: float = 0.0
    second_lead: float = 0.0
    third_lead: float = 0.0
    fourth_lead: float = 0.0
    has_series: bool = False
    series_waves: float = 0.0

    def has_curve(self, waves: float, lead: float) -> bool:
        """Whether a curve is paid for."""
        return (waves, lead) in self._known()

    def has_series_of(self, waves: float) -> bool:
        """Whether the series of these waves is paid for."""
        return self.has_series and self.series_waves == waves

    def with_curve(self, waves: float, lead: float) -> PaidTables:
        """The same with a curve.

        Where more come than the cache has places for beside the series, that may be gone.
        """
        known = self._known()
        if (waves, lead) in known:
            return self
        full = len(known) == MAX_LEADS
        known = [*known[full:], (waves, lead)]
        rest = [(0.0, 0.0)] * (MAX_LEADS - len(known))
        (first, second, third, fourth) = (*known, *rest)
        return PaidTables(
            len(known),
            *(first[0], second[0], third[0], fourth[0]),
            *(first[1], second[1], third[1], fourth[1]),
            has_series=self.has_series and not full,
            series_waves=self.series_waves,
        )

    def with_series(self, waves: float) -> PaidTables:
        """The same with the series."""
        if self.has_series_of(waves):
            return self
        return PaidTables(has_series=True, series_waves=waves)

    def _known(self) -> list[tuple[float, float]]:
        waves = self.first_waves, self.second_waves, self.third_waves, self.fourth_waves
        leads = self.first_lead, self.second_lead, self.third_lead, self.fourth_lead
        return list(zip(waves, leads, strict=True))[: self.curves]


class Swing(NamedTuple):
    """Displacement [m] and velocity [m/s] of the resonator's own swing."""

    displacement: float = 0.0
    rate: float = 0.0


class OpenKind(IntEnum):
    """What the estimate of the error has still to take in.

    Nothing, motion on orbits, or such that begins where resolved motion ends.
    """

    NOTHING_OPEN = 0
    FOLLOWED = 1
    TAKEN_OVER = 2


class OpenError(NamedTuple):
    """That motion: `elapsed` [s] under held inputs.

    From a slow `velocity` [m/s] and a drive phase `angle` [rad] over all turns on. Where resolved
    motion ended, the resonator had the `displacement` [m] and the `rate` [m/s].
    """

    kind: int = OpenKind.NOTHING_OPEN
    elapsed: float = 0.0
    velocity: float = 0.0
    angle: float = 0.0
    displacement: float = 0.0
    rate: float = 0.0


class OrbitState(NamedTuple):
    """The state beside the moment.

    `to_go` is the drive angle [rad] that is still to be resolved, `waited` what has been, or on an
    orbit whose lead drifts what has been followed. On an orbit: slow velocity V [m/s], slow centre
    [m] and lead [rad] of the normal load, and what is left of the resonator's own `swing`, by which
    it differs from the orbit. The step was made `under` these values; `tunings` counts, up to
    MAX_TUNINGS, how often a parameter changed the orbits. W is `ahead` [m/s] of that of the full
    device, as far as that is known; what else V may err by is `doubt` [m/s], and the resonator's
    swing that nobody follows is `unrest` [m/s] of mean velocity. `acceleration` [m/s^2] is the slow
    one. The last four are those before what is `open`, which is measured only where an estimate is
    needed.
    """

    stage: int = Stage.AVERAGED
    to_go: float = 0.0
    waited: float = 0.0
    velocity: float = 0.0
    centre: float = 0.0
    lead: float = 0.0
    swing: Swing = Swing()
    under: OrbitValues = OrbitValues()
    leads: VisitedLeads = VisitedLeads()
    paid: PaidTables = PaidTables()
    tunings: int = 0
    ahead: float = 0.0
    doubt: float = 0.0
    unrest: float = 0.0
    acceleration: float = 0.0
    open: OpenError = OpenError()

    def resolved_for(self, angle: float) -> OrbitState:
        """The same when motion is to be resolved for a drive angle [rad] at least."""
        if self.stage == Stage.RESOLVED:
            return self._replace(to_go=max(self.to_go, angle))
        return self._replace(stage=Stage.RESOLVED, to_go=max(0.0, angle), waited=0.0)


NO_ORBIT = OrbitState()
"""The state beside a moment that serves no averages of second order."""
