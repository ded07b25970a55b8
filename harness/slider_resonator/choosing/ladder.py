"""The candidate communication steps of a scene."""

from __future__ import annotations

from math import ceil, floor, inf, log2

from slider_resonator.choosing.coverage import SIGNAL_NEEDS
from slider_resonator.choosing.probe import Probe
from slider_resonator.device import schedule

MAX_PERIODS = 10_000
"""Maximum drive periods in a step: beyond, the overhead of a step is negligible."""
MAX_RELAXATIONS = 2000
"""The same for averaged motion, in relaxation times: FMUs bound the work of a step."""
STEPS_PER_BEAT = 4.0, 8.0
"""Steps in a beat, from the fewest on, up to a number that shows its form, too."""
BEAT_POINTS = 64, 128
"""The same for the points of a run from which a beat is read."""
FINEST = 64
"""Maximum steps in a drive period."""


def step_ladder(probe: Probe) -> tuple[float, ...]:
    """Return the steps (s) to choose from, descending; one where held inputs are no error.

    They are the scene's own step times powers of two. Signals are needed at every step of the
    scene, which is then the longest; a beat needs some steps each, and how many is tried; a number
    at the end needs one. Input jumps are communication points in any case.
    """
    own = probe.scene.step_size or probe.duration
    scales = probe.scales
    longest = min(probe.duration, MAX_PERIODS * scales.period, MAX_RELAXATIONS * scales.relaxation)
    if SIGNAL_NEEDS & set(probe.run_needs):
        longest = min(longest, own)
    shortest = longest
    if "beat" in probe.run_needs:
        beat = 1.0 / scales.beat if scales.beat else inf
        spaces = (BEAT_POINTS, probe.probed_duration), (STEPS_PER_BEAT, beat)
        shortest = min(longest, *(length / most for (_, most), length in spaces))
        longest = min(longest, *(length / least for (least, _), length in spaces))
    elif not (probe.varying or SIGNAL_NEEDS & set(probe.run_needs)):
        return (longest,)
    first = own * 2.0 ** floor(log2(longest / own * (1.0 + 1e-9)))
    if not probe.varying:
        return tuple(first * 2.0**-index for index in range(ceil(log2(first / shortest)) + 1))
    finest = max(scales.period / FINEST, probe.duration / schedule.MAX_STEPS)
    if probe.covers != "windows":
        finest = max(finest, probe.probed_duration / probe.max_steps)
    count = max(1, floor(log2(first / finest)) + 1)
    return tuple(first * 2.0**-index for index in range(count))
