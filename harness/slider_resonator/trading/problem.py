"""The problem that every method solves, its solutions, and the errors of these.

It is the full device of a scene under its inputs.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks import measures
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import DrivePeriods, common_period
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.device.schedule import Schedule, nearest, schedule
from slider_resonator.device.signal import Signal
from slider_resonator.references.averaged.averaged_motion import MAX_DETUNING
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.scenes.scene import Scene
from slider_resonator.steady.searches import SteadyAnswer
from slider_resonator.trading.result import Row

MIN_PERIODS = 1000
"""Minimum drive periods of a run under constant inputs: the longest communication step."""
POINTS = 16
"""Readings in a window, which is a drive period long."""


@dataclass(frozen=True)
class Solution:
    """Signals at `times` (s) and counts over the run, None where the method does not report them.

    `position` (m) and `velocity` (m/s) have the shape (n,) of the times, `mean_velocity` (m/s) too
    where the method has one of its own, `last_event` (s) where it locates events. `history` holds
    the times and mean velocities of its own steps, for the beat. `start_cpu` is the CPU time (s) of
    initialisation.
    """

    times: Array
    position: Array
    velocity: Array
    mean_velocity: Array | None = None
    last_event: Array | None = None
    history: tuple[Array, Array] | None = None
    steps: int | None = None
    evaluations: int | None = None
    events: int | None = None
    start_cpu: float | None = None


Readings = Mapping[str, Array]
"""What is compared by name, a row for each window of a problem, shape (w,) or (w, POINTS + 1).

Without `last_event` where no event is located.
"""


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
        """The drive periods at whose ends the windows are: all, half of them, and so on."""
        halves = {self.periods // 2**halving for halving in range(6)}
        return tuple(sorted(halves - {0}))

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

    def read(self, solution: Solution, periods: int) -> Readings:
        """Return the readings of a solution over `periods` drive periods, window by window."""
        times = self.windows(periods)
        places = np.array([nearest(solution.times, window) for window in times])
        position, last = solution.position[places], places[:, -1]
        lengths = times[:, -1] - times[:, 0]
        mean = (position[:, -1] - position[:, 0]) / lengths
        if solution.mean_velocity is not None:
            mean = solution.mean_velocity[last]
        parts = zip(times, position, lengths, strict=True)
        slow = [measures.slow_displacement(*part)[-1] for part in parts]
        return {
            "mean_velocity": mean,
            "slow_displacement": np.array(slow),
            "position": position,
            "velocity": solution.velocity[places],
            **({} if solution.last_event is None else {"last_event": solution.last_event[last]}),
        }

    def errors(self, solution: Solution, reference: Readings, periods: int) -> dict[str, float]:
        """Return the error of each quantity of a solution, infinite where it is not finite."""
        reported = {}
        for name, found in self.read(solution, periods).items():
            if name not in reference:
                continue
            expected = reference[name][: len(found)]
            off = measures.peak(found - expected)
            if name == "last_event":
                reported["event_times"] = off / self.period
            else:
                reported[name] = measures.share_of(off, measures.peak(expected))
        if self.beat is not None and solution.history is not None:
            beat = _beat(*solution.history, self.beat)
            if beat is not None:
                reported["beat_frequency"] = abs(beat - self.beat) / self.beat
        return {name: error if np.isfinite(error) else np.inf for name, error in reported.items()}


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


@dataclass(frozen=True)
class SteadyMethod:
    """A method to find a steady velocity (m/s) or a blocking force (N), the answer of its `row`.

    `find` takes its budget of CPU time (s) and raises RuntimeError where that is exceeded.
    """

    row: Row
    find: Callable[[float], SteadyAnswer]


@dataclass(frozen=True)
class Method:
    """A method to follow a motion, and the row that it fills.

    `run` follows it over a number of drive periods and returns its CPU time (s), too; `seconds`
    does so without the readings and returns the CPU time (s), without initialisation. A run has at
    least `min_periods`; a method that `cannot_stick` does not cover sticking. `missing` gives the
    reason for each quantity that the method does not compute, `answers` are its searches.
    """

    row: Row
    run: Callable[[int], tuple[float, Solution]]
    seconds: Callable[[int], float]
    min_periods: int = 1
    cannot_stick: bool = False
    missing: Mapping[str, str] = field(default_factory=dict)
    answers: Sequence[SteadyMethod] = ()


def solution_of(run: Trajectory, *, located: bool) -> Solution:
    """Return a trajectory as a solution; reversals stand for events that are not located."""
    last = np.append(0.0, run.event_times)[np.searchsorted(run.event_times, run.time, "right")]
    return Solution(
        times=run.time,
        position=run.position,
        velocity=run.velocity,
        last_event=last if located else None,
        steps=run.steps or None,
        evaluations=run.evaluations,
        events=len(run.event_times if located else run.reversal_times),
    )


def _beat(times: Array, mean_velocity: Array, beat: float) -> float | None:
    """Return the frequency (Hz) in the later half, None where it is sampled too thinly."""
    if len(times) < 32:
        return None
    steps = np.diff(times)
    if abs(steps[-1] - steps[0]) > 1e-6 * steps[0]:
        times, mean_velocity = times[:-1], mean_velocity[:-1]
    half = len(times) // 2
    later = times[half:]
    beats = (later[-1] - later[0]) * beat
    if len(later) < 16 or not beats > 2.0 or beats > 0.4 * (len(later) - 1):
        return None
    try:
        return measures.dominant_frequency(later, mean_velocity[half:])
    except measures.NoOscillation:
        return np.inf
