"""What averages of second order do in a run: resolve motion, prepare orbits, follow them.

The rules are those of the component (fmu_src/README.md, averages of second order): the first orbits
follow a resolved start, and each further table of orbits is paid for beforehand by resolved motion
that costs as much. That of a lead that drifts from the start is paid for by searches.
"""

from __future__ import annotations

from dataclasses import dataclass

from slider_resonator.studies.choose.candidate import COULOMB, LUGRE
from slider_resonator.studies.choose.plan import Plan, Stay
from slider_resonator.studies.choose.scales import Scales, longest_memory

CURVES = 4
"""Leads, and changes of a parameter, up to which each has a curve of orbits."""
SERIES_CURVES = 9
"""Curves in the series over leads, from which those of more leads are combined."""
SMALLEST_START = 8.0
"""Drive periods that are resolved at the start at least."""
FAST_DRIFT = 3e-3
"""Beats in a drive period beyond which the series over leads is too coarse for bristles."""
MEMORIES = 16.0
"""Memories of resonator and bristle in the resolved start."""


@dataclass(frozen=True)
class Paid:
    """Drive periods of resolved motion by which each source of orbits is paid for."""

    curve: float
    series: float
    search: float


PAID = {COULOMB: Paid(400.0, 4300.0, 160.0), LUGRE: Paid(450.0, 4600.0, 600.0)}
"""By friction law, as in the component."""


@dataclass
class OrbitWork:
    """Drive periods of a run that are resolved, that follow tables, and that search their orbits.

    Those that `drifting` counts are among the tabulated ones; the beats are the turns of the slow
    phase in either. `curves` are tabulated, those of a series
    counted, too; `changes` are those of the lead that orbits follow, `combined` those among them to
    a lead whose curve is made from the series.
    """

    resolved: float = 0.0
    tabulated: float = 0.0
    drifting: float = 0.0
    searched: float = 0.0
    tabulated_beats: float = 0.0
    searched_beats: float = 0.0
    curves: int = 0
    changes: int = 0
    combined: int = 0


def orbit_work(plan: Plan, scales: Scales, law: int) -> OrbitWork:
    """Return the work of a run under a friction law that has slow motion."""
    return _Following(scales, law).work(plan)


def resolved_start(scales: Scales, law: int) -> float:
    """Return the drive periods of the resolved start under a friction law."""
    return max(SMALLEST_START, MEMORIES * longest_memory(scales, law))


class _Following:
    """The stages through which the component goes."""

    def __init__(self, scales: Scales, law: int) -> None:
        self.law, self.lifts = law, scales.lifts
        self.start = resolved_start(scales, law)
        self.paid = PAID[law]
        self.done = OrbitWork()
        self.resolves, self.to_go, self.waited = True, self.start, 0.0
        self.leads: set[object] = set()
        self.tables: set[object] = set()
        self.bought: set[object] = set()
        self.tunings = 0

    def work(self, plan: Plan) -> OrbitWork:
        for index, stay in enumerate(plan.stays):
            if index:
                self._change(stay)
            self._follow(stay)
        return self.done

    def _source(self, stay: Stay) -> object:
        """Return the table of a stay: its lead, "series", or "search" without any."""
        many = len(self.leads | {stay.lead}) > CURVES
        if self.law == LUGRE and stay.beats > FAST_DRIFT * stay.periods:
            return "search"
        if self.tunings >= CURVES or ((stay.drifts or many) and self.lifts):
            return "search"
        return "series" if stay.drifts or many else stay.lead

    def _price(self, stay: Stay) -> float:
        source = self._source(stay)
        if source in self.bought:
            return 0.0
        prices = {"search": self.paid.search, "series": self.paid.series}
        return prices.get(str(source), self.paid.curve)

    def _buy(self, source: object) -> None:
        if source != "search":
            self.bought.add(source)

    def _change(self, stay: Stay) -> None:
        if stay.goes_on:
            return
        if stay.tuned:
            self.tunings += 1
            self.bought.clear()
            self.tables.clear()
        price = self._price(stay)
        if self.resolves:
            if self.waited > 0.0:
                self.to_go = max(self.to_go, price - self.waited)
        elif price > 0.0 or stay.driven:
            self.resolves, self.to_go, self.waited = True, price, 0.0
            self._buy(self._source(stay))
        else:
            self.done.changes += stay.count
            if self._source(stay) == "series" and not stay.drifts:
                self.done.combined += stay.count
        if stay.driven:
            self.to_go = max(self.to_go, self.start)

    def _follow(self, stay: Stay) -> None:
        left = stay.periods
        if self.resolves:
            resolved = min(self.to_go, left)
            self.done.resolved += resolved
            self.to_go, self.waited = self.to_go - resolved, self.waited + resolved
            left -= resolved
            if left <= 0.0:
                return
            self.resolves, self.waited = False, 0.0
        if not stay.goes_on:
            self.leads.add(stay.lead)
        source, beats = self._source(stay), stay.beats / stay.periods
        searched = left if source == "search" else min(left, self._searched_first(stay))
        self.waited += searched
        self.done.searched += searched
        self.done.searched_beats += beats * searched
        left -= searched
        if left <= 0.0:
            return
        if source not in self.tables:
            self.done.curves += SERIES_CURVES if source == "series" else 1
            self.tables.add(source)
        self._buy(source)
        self.done.tabulated += left
        self.done.drifting += left if stay.drifts else 0.0
        self.done.tabulated_beats += beats * left

    def _searched_first(self, stay: Stay) -> float:
        """Return the periods for which a lead that drifts is searched until its series is due."""
        due = not stay.drifts or self._source(stay) in self.bought
        return 0.0 if due else max(0.0, self.paid.series - self.waited)
