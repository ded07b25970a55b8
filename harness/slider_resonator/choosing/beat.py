"""The beat beside an integer frequency ratio: its frequency, and whether a run shows it."""

from slider_resonator.choosing.errors import ErrorEstimate
from slider_resonator.scenes.scene import Scene

NEAR_AN_INTEGER = 0.1
"""Distance of the frequency ratio from an integer within which the phase turns slowly."""
MIN_BEATS = 2.0
"""Beats in the later half of a run from which their frequency can be read."""
SHOWN, HARMONICS = 0.2, (1, 2, 3)
"""Distance of a frequency from the beat or a multiple of it, in beats, up to which it is that."""


def beat_frequency(scene: Scene) -> float:
    """Return the difference frequency (Hz) at the starting ratio, 0 unless near an integer."""
    ratio = scene.signals["frequency_ratio"].at(0.0)
    detuning = abs(ratio - round(ratio))
    return detuning / scene.drive_period if detuning < NEAR_AN_INTEGER else 0.0


def lacking_beat(scene: Scene) -> str:
    """Return the reason why a run of the scene has no beat, empty where it has one."""
    ratio = scene.signals["frequency_ratio"]
    if len(set(ratio.values)) > 1:
        return "the frequency ratio changes, and the beat with it"
    beat = beat_frequency(scene)
    if beat == 0.0:
        where = f"no beat at frequency_ratio = {ratio.values[0]:.9g}"
        if ratio.values[0] == round(ratio.values[0]):
            return f"{where}: at an integer the difference of the two phases is constant"
        return f"{where}: it is farther than {NEAR_AN_INTEGER:g} from an integer"
    beats = 0.5 * (scene.stop_time or 0.0) * beat
    if beats < MIN_BEATS:
        return f"the later half of the run has {beats:.2g} beats; {MIN_BEATS:g} show one"
    return ""


def unseen_beat(seen: ErrorEstimate, beat: float) -> str:
    """Return the reason why a frequency read from the resolved run is not `beat`, both in Hz.

    Empty where it is. A slow motion that beats less than it drifts has its strongest oscillation
    elsewhere.
    """
    found = seen.magnitude
    if any(abs(found - n * beat) <= SHOWN * beat for n in HARMONICS):
        return ""
    where = f"no beat of {beat:.4g} Hz in the resolved run"
    return seen.reason or f"{where}: its strongest oscillation has {found:.4g} Hz"
