"""How much of a scene is resolved to confirm a choice: the whole, windows or the beginning."""

from __future__ import annotations

from functools import cached_property
from math import inf

from slider_resonator.choosing.candidate import Model
from slider_resonator.choosing.input_grid import vary
from slider_resonator.choosing.resolved_cost import period_cost
from slider_resonator.choosing.scales import Scales
from slider_resonator.choosing.windows import (
    WINDOW_PERIODS,
    WINDOWS,
    corner_periods,
    even_starts,
    head_end,
    places,
    settling,
)
from slider_resonator.scenes.scene import Scene

FINEST_TOLERANCE = 1e-13
"""Tolerance of the resolved LuGre device, the reference of all candidates."""
MAX_STEPS = 10_000
"""Steps of a candidate in the probe, where inputs vary."""
SHORT, LONG = 0.015, 0.4
"""Costs (s) of the resolved run up to which a scene is always, and up to which it can be, resolved
as a whole."""
HEAD_PERIODS, MIN_PERIODS = 1000.0, 100.0
"""Drive periods that are resolved at the beginning of a longer scene."""
CHEAP_PERIOD = 3e-6
"""Cost (s) of a drive period up to which these numbers hold; more expensive ones are fewer."""
NEARLY_WHOLE = 4.0
"""Length of a scene, in beginnings, up to which it is rather resolved as a whole."""
MAX_SLOWNESS = 0.05
"""Largest friction over vibration at which averaged motion is used between windows."""
MAX_SETTLING = 0.5
"""Largest share of a window in which resonator and bristle may forget its start."""
MAX_CORNERS = 40
"""Largest number of corners of the inputs for which windows are laid."""
MAX_COVERED = 0.5
"""Largest share of a scene in windows: beyond, all of it is hardly more."""
BEATS = 0.25
"""Largest number of beats between two windows for which windows suffice."""
SIGNAL_NEEDS = frozenset({"position", "velocity", "event_times"})
"""Needs that are judged at every step of the scene, not at its end only."""


class Coverage:
    """The resolved part of a scene whose `run_needs` are measured in a run.

    `part` is "whole", "windows" or "beginning", `varying` says whether an input varies other than
    by jumps, and `corners` are the drive periods at which inputs jump or change their slope.
    """

    def __init__(
        self, scene: Scene, scales: Scales, reference: Model, run_needs: list[str]
    ) -> None:
        self.scene = scene
        self.scales = scales
        self.run_needs = run_needs
        self.duration = scene.stop_time or 0.0
        self.periods = self.duration / scales.period
        self.varying = vary(scene, self.duration)
        self.corners = corner_periods(scene, self.duration)
        self._period_cost = period_cost(reference, FINEST_TOLERANCE, scales)
        self._settling = settling(scales, reference.friction_law)

    @cached_property
    def part(self) -> str:
        """The resolved part of the scene: whole, windows or beginning."""
        if self.can_be_whole and self._cost <= SHORT:
            return "whole"
        if self._shows_in_windows():
            return "windows"
        return "whole" if self.can_be_whole else "beginning"

    @cached_property
    def can_be_whole(self) -> bool:
        """Whether the scene can be resolved as a whole."""
        often = self.varying and SIGNAL_NEEDS & set(self.run_needs)
        points = self.duration / (self.scene.step_size or inf) if often else 0.0
        nearly = self.periods <= NEARLY_WHOLE * self._beginning
        return (nearly or self._cost <= LONG) and points <= MAX_STEPS

    @property
    def longest(self) -> float:
        """Length (s) of the longest stretch that is resolved."""
        if self.part == "whole":
            return self.duration
        if self.part == "windows":
            return self._head * self.scales.period
        return min(self._beginning * self.scales.period, self.duration)

    @property
    def _cost(self) -> float:
        """Cost (s) of resolving the whole scene."""
        return self._period_cost * self.periods

    @property
    def _beginning(self) -> float:
        """Drive periods of the beginning."""
        return max(MIN_PERIODS, HEAD_PERIODS * min(1.0, CHEAP_PERIOD / self._period_cost))

    @cached_property
    def _head(self) -> int:
        """Whole drive periods that are resolved before the first window."""
        return head_end(self._beginning, self.corners, self._settling)

    def _shows_in_windows(self) -> bool:
        """Whether windows represent the whole scene."""
        beats = self.scales.beat * self.duration / WINDOWS
        settled = self._settling <= MAX_SETTLING * WINDOW_PERIODS
        one_ratio = len(set(self.scene.signals["frequency_ratio"].values)) == 1
        events = self.varying and "event_times" in self.run_needs
        slow = self.scales.slowness is not None and self.scales.slowness <= MAX_SLOWNESS
        few = len(self.corners) <= MAX_CORNERS
        calm = slow and settled and few and beats <= BEATS and not self.scene.tuning
        return calm and one_ratio and not events and self._covered() <= MAX_COVERED

    def _covered(self) -> float:
        """Share of the scene that head and windows take."""
        if self._head >= self.periods - WINDOW_PERIODS:
            return 1.0
        spread = even_starts(self._head, self.periods)
        spans = places(self._head, self.periods, self.corners, self._settling, spread)
        return (self._head + sum(stop - start for start, stop in spans)) / self.periods
