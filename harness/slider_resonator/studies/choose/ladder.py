"""The candidate communication steps of a scene."""

from __future__ import annotations

from math import floor, log2

from slider_resonator.device import schedule
from slider_resonator.studies.choose.coverage import MAX_STEPS, SIGNAL_NEEDS
from slider_resonator.studies.choose.probe import Probe

MAX_PERIODS = 10_000
"""Maximum drive periods in a step: beyond, the overhead of a step is negligible."""
MAX_RELAXATIONS = 2000
"""The same for averaged motion, in relaxation times: FMUs bound the work of a step."""
STEPS_PER_BEAT = 8
BEAT_POINTS = 128
"""Points in a run from which a beat is read, at least."""
FINEST = 64
"""Maximum steps in a drive period."""


def step_ladder(probe: Probe) -> tuple[float, ...]:
    """Return the steps (s) to choose from, descending; one where the inputs do not vary.

    They are the scene's own step times powers of two. Signals are needed at every step of the
    scene, which is then the longest; a beat needs some steps each; a number at the end needs one.
    Input jumps are communication points in any case.
    """
    own = probe.scene.step_size or probe.duration
    scales = probe.scales
    longest = min(probe.duration, MAX_PERIODS * scales.period, MAX_RELAXATIONS * scales.relaxation)
    if SIGNAL_NEEDS & set(probe.run_needs):
        longest = min(longest, own)
    if "beat" in probe.run_needs:
        longest = min(longest, probe.probed_duration / BEAT_POINTS)
        if scales.beat:
            longest = min(longest, 1.0 / (STEPS_PER_BEAT * scales.beat))
    elif not (probe.varying or SIGNAL_NEEDS & set(probe.run_needs)):
        return (longest,)
    first = own * 2.0 ** floor(log2(longest / own * (1.0 + 1e-9)))
    if not probe.varying:
        return (first,)
    finest = max(scales.period / FINEST, probe.duration / schedule.MAX_STEPS)
    if probe.covers != "windows":
        finest = max(finest, probe.probed_duration / MAX_STEPS)
    count = max(1, floor(log2(first / finest)) + 1)
    return tuple(first * 2.0**-index for index in range(count))
