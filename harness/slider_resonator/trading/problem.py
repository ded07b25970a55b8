"""The problem that every method solves: the full device of a scene under its inputs."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import DrivePeriods, common_period
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.device.schedule import Schedule, schedule
from slider_resonator.device.signal import Signal
from slider_resonator.references.averaged.averaged_motion import MAX_DETUNING
from slider_resonator.scenes.scene import Scene

MIN_PERIODS = 1000
"""Minimum drive periods of a run under constant inputs: the longest communication step."""
HALVINGS = 5
"""The motion is read in windows that end at the end of the run, at half of it, and so on."""
POINTS = 16
"""Readings in a window, which is a drive period long."""


@dataclass(frozen=True)
class Problem:
    """A scene as a problem for every method.

    `device` is the full device under the scene's friction law, whatever fidelity the scene asks
    for; `signals` are its inputs, `tuning` is what it changes of drive and contact, in steps.
    `drive` has the drive periods, of which a run has `periods`.
    """

    name: str
    title: str
    device: Device
    parameters: Mapping[str, float]
    signals: Mapping[str, Signal]
    tuning: Mapping[str, Signal]
    drive: DrivePeriods
    periods: int

    @property
    def period(self) -> float:
        """Drive period in s, without deviation."""
        return self.drive.period

    @property
    def constant(self) -> bool:
        """Whether no input varies within the run, and nothing of drive and contact."""
        stop = self.duration(self.periods)
        return not self.tuning and all(
            len(set(signal.values)) == 1 or signal.times[0] >= stop
            for signal in self.signals.values()
        )

    @property
    def inputs(self) -> dict[str, float]:
        """The inputs at the start."""
        return {name: signal.at(0.0) for name, signal in self.signals.items()}

    @property
    def steady(self) -> bool:
        """Whether the inputs allow a steady motion, and friction draws the slider into it."""
        rubs = self.device.max_friction > 0.0
        periodic = common_period(self.inputs["frequency_ratio"]) is not None
        return rubs and self.constant and periodic

    @property
    def beat(self) -> float | None:
        """Frequency (Hz) of the beat of two frequencies near each other, None where none is.

        It is the difference of the frequencies exactly, appendix A of the paper.
        """
        ratio = self.inputs["frequency_ratio"]
        detuning = abs(ratio - round(ratio))
        apart = 1e-9 < detuning < MAX_DETUNING
        return detuning / self.period if self.constant and apart else None

    @property
    def horizons(self) -> tuple[int, ...]:
        """The drive periods at whose ends the windows are."""
        halves = {self.periods // 2**halving for halving in range(HALVINGS + 1)}
        return tuple(sorted(halves - {0}))

    @property
    def lengths(self) -> tuple[int, ...]:
        """The drive periods after which a method may stop, all of them where inputs vary."""
        return self.horizons if self.constant else (self.periods,)

    def windows(self, periods: int) -> Array:
        """Return the times (s), shape (w, POINTS + 1), of the readings in the windows of a run."""
        ends = np.array([end for end in self.horizons if end <= periods], np.float64)
        return self.drive.instants(ends[:, None] - 1.0 + np.arange(POINTS + 1) / POINTS)

    def readings(self, periods: int) -> Array:
        """Return the times (s) of the readings in all windows of a run, ascending."""
        return np.unique(self.windows(periods))

    def ends(self, periods: int) -> Array:
        """Return the times (s), shape (periods + 1,), at which drive periods begin and end."""
        return self.drive.instants(np.arange(periods + 1.0))

    def duration(self, periods: int) -> float:
        """Return how long drive periods take from the start on, s."""
        return float(self.drive.instants(np.array(periods)))

    def schedule(self, periods: int, step: float, *, interpolates: bool = False) -> Schedule:
        """Return the inputs sampled at steps (s) and held; all their jumps are points.

        One that `interpolates` passes straight lines on; all their corners are points.
        """
        stop = self.duration(periods)
        return schedule(stop, step, self.tuning, interpolates, **self.signals)

    def lines(self, periods: int) -> list[HeldInputs]:
        """Return the inputs of reference and peers: straight lines from corner to corner."""
        return self.schedule(periods, self.duration(periods), interpolates=True).held()


def problem_of(scene: Scene, varied: Mapping[str, float], max_periods: int | None) -> Problem:
    """Return the problem of a scene; `varied` are the values of its sweep.

    What a scene tunes is held over its own steps, for all methods. `max_periods` cuts the run
    short. Raises SceneError for a scene without a run whose inputs vary.
    """
    full = scene.device.tuned([("fidelity", 2)])
    varying = scene.tuning or any(len(set(one.values)) > 1 for one in scene.signals.values())
    tuning: Mapping[str, Signal] = {}
    periods, drive = MIN_PERIODS, scene.drive_periods
    if varying or scene.stop_time is not None:
        plan = scene.schedule()
        tuning = plan.held_tuning
        periods = int(drive.whole(plan.times[-1:])[0])
        if not varying:
            periods = max(periods, MIN_PERIODS)
    if max_periods is not None:
        periods = min(periods, max_periods)
    own = {"fidelity", "averaging_order", "friction_law", "tolerance"}
    at = "".join(f", {name} {value:g}" for name, value in varied.items())
    return Problem(
        name=scene.name + at,
        title=scene.title,
        device=full,
        parameters={k: v for k, v in scene.parameters.items() if k not in own},
        signals=scene.signals,
        tuning=tuning,
        drive=drive,
        periods=max(periods, 1),
    )
