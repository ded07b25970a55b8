"""Whether a run shows the beat that a scene needs."""

from __future__ import annotations

from slider_resonator.choosing.errors import ErrorEstimate
from slider_resonator.choosing.scales import NEAR_AN_INTEGER, Scales
from slider_resonator.scenes.scene import Scene

MIN_BEATS = 2.0
"""Beats in the later half of a run from which their frequency can be read."""
SHOWN, HARMONICS = 0.2, (1, 2, 3)
"""Distance of a frequency from the beat or a multiple of it, in beats, up to which it is that."""


def lacking_beat(scene: Scene, scales: Scales) -> str:
    """Return the reason why a run of the scene has no beat, empty where it has one."""
    ratio = scene.signals["frequency_ratio"]
    if len(set(ratio.values)) > 1:
        return "the frequency ratio changes, and the beat with it"
    if scales.beat == 0.0:
        where = f"no beat at frequency_ratio = {ratio.values[0]:.9g}"
        if scales.detuning == 0.0:
            return f"{where}: at an integer the difference of the two phases is constant"
        return f"{where}: it is farther than {NEAR_AN_INTEGER:g} from an integer"
    beats = 0.5 * (scene.stop_time or 0.0) * scales.beat
    if beats < MIN_BEATS:
        return f"the later half of the run has {beats:.2g} beats; {MIN_BEATS:g} show one"
    return ""


def unseen_beat(seen: ErrorEstimate, scales: Scales) -> str:
    """Return the reason why a beat (Hz) read from the resolved run is none, empty where it is one.

    A slow motion that beats less than it drifts has its strongest oscillation elsewhere.
    """
    found, beat = seen.magnitude, scales.beat
    if any(abs(found - n * beat) <= SHOWN * beat for n in HARMONICS):
        return ""
    where = f"no beat of {beat:.4g} Hz in the resolved run"
    return seen.reason or f"{where}: its strongest oscillation has {found:.4g} Hz"
