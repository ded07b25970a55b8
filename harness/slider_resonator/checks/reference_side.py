"""The references in a scene: trajectories, averaged motion, steady motion, each computed once."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi, tau
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.checks.measures import Tube, slow_displacement
from slider_resonator.checks.period_means import COINCIDENCE, last_events, quadrature
from slider_resonator.device.device import FULL, Device
from slider_resonator.device.drive_periods import DrivePeriods
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.device.schedule import nearest
from slider_resonator.references.averaged import device_average
from slider_resonator.references.averaged.averaged_motion import AveragedMotion, simulate_averaged
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.vocabulary import RESOLVED
from slider_resonator.steady.reference_steady import ReferenceMotion


@dataclass(frozen=True)
class SteadyReferences:
    """Steady motion, predictions and closed forms for a device under constant inputs.

    `phase` in rad, `load` in N. Velocities are in m/s, forces in N, each computed on first use.
    """

    device: Device
    phase: float
    load: float
    frequency_ratio: float

    @cached_property
    def steady_velocity(self) -> float | None:
        """Mean velocity of the steady motion, by shooting with located events."""
        try:
            guess = self.predicted_velocity
        except ValueError:
            guess = 0.0
        return self._motion.steady_velocity(self.load, guess)

    @cached_property
    def blocking_force(self) -> float | None:
        """Load that makes the mean velocity zero, by shooting with located events."""
        return self._motion.blocking_force()

    @property
    def _motion(self) -> ReferenceMotion:
        return ReferenceMotion(self.device, self.phase, self.frequency_ratio)

    @cached_property
    def full_device(self) -> "SteadyReferences":
        """The same for the full device, whatever the fidelity."""
        return replace(self, device=self.device.tuned([("fidelity", FULL)]))

    @property
    def predicted_velocity(self) -> float:
        """Steady velocity of averaged motion: any ratio, both laws, with lift-off."""
        inputs = (self.phase, self.load, self.frequency_ratio)
        return device_average.steady_velocity(self.device, *inputs)

    @property
    def predicted_blocking_force(self) -> float:
        """Blocking force of averaged motion, as for `predicted_velocity`."""
        return device_average.blocking_force(self.device, self.phase, self.frequency_ratio)

    @property
    def prediction_valid(self) -> float:
        """1 where averaged theory applies, 0 where not."""
        inputs = (self.phase, self.load, self.frequency_ratio)
        return float(device_average.prediction_valid(self.device, *inputs))

    @property
    def of_paper(self) -> "SteadyReferences":
        """The same for Coulomb friction, of which averages are (5), (20) and, for all faces, (22).

        Raises ValueError where these do not hold.
        """
        if self.frequency_ratio != 1.0:
            raise ValueError(
                f"frequency_ratio = {self.frequency_ratio!r}: the closed form allows only 1"
            )
        if self.device.normal_amplitude > self.device.normal_preload:
            raise ValueError(
                f"normal_amplitude = {self.device.normal_amplitude!r} N must be at most "
                f"normal_preload = {self.device.normal_preload!r} N: where the contact lifts the "
                "closed form does not hold"
            )
        return replace(self, device=self.device.tuned([("friction_law", 0)]))

    @property
    def ripple_amplitude(self) -> float:
        """Amplitude (m) of the fast displacement, (33)-(34)."""
        return equivalent_force(self.device).ripple_amplitude

    @property
    def difference_frequency(self) -> float:
        """Distance (Hz) of the normal force's frequency from a multiple of the drive's: the beat.

        For a ratio near 1 it is that of appendix A.
        """
        ratio = self.frequency_ratio
        return abs(ratio - round(ratio)) * self.device.drive_frequency / (2.0 * pi)


TUBE_POINTS = 3
"""Points on each side of a time at which a tube samples the reference."""


class ReferenceSide:
    """The references in one scene, computed on first use."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.device = scene.device
        self._around: dict[float, Trajectory] = {}

    def by(self, reference: str) -> "ReferenceSide":
        """Return this for a reference with the fast motion, `located_events` or `bristle_state`.

        Raises ValueError where the scene has the other friction law.
        """
        law, own = RESOLVED.index(reference), self.device.friction_law
        if own != law:
            raise ValueError(f"friction_law = {own!r}: {reference} is for {law}")
        return self

    @cached_property
    def times(self) -> Array:
        """Times of the scene (s) at which outputs are read, shape (n,)."""
        return self.scene.schedule().readings()

    @cached_property
    def trajectory(self) -> Trajectory:
        """The trajectory at the communication points and the ends of periods that means need."""
        every = any(expect.quantity == "mean_velocity_in_run" for expect in self.scene.expect)
        means = self.times if every else self.times[-1:]
        return self._simulate(np.union1d(self.times, self.scene.drive_periods.ends(means)))

    def signal(self, name: str) -> Array:
        """Return one output of the trajectory at the communication points, shape (n,)."""
        run = self.trajectory
        values = np.asarray(getattr(run, name), dtype=np.float64)
        return values[np.searchsorted(run.time, self.times)]

    def tube(self, name: str, share: float) -> Tube:
        """Return one output with its range within a share of a drive period to each side."""
        offsets = share * self.scene.drive_period * np.linspace(-1.0, 1.0, 2 * TUBE_POINTS + 1)
        around = np.clip(self.times[:, None] + offsets, 0.0, self._simulated_until)
        if share not in self._around:
            self._around[share] = self._simulate(np.unique(around))
        run = self._around[share]
        values = np.asarray(getattr(run, name), dtype=np.float64)
        window = values[np.searchsorted(run.time, around)]
        return Tube(window[:, TUBE_POINTS], window.min(axis=1), window.max(axis=1))

    def beside_events(self, name: str) -> Tube:
        """Return one output, with both of its values where an event coincides with a time.

        An event at the start or at a change of inputs has one right side, and is not meant.
        """
        signal = self.signal(name)
        events = self.trajectory.event_times
        changes = np.array([held.start for held in self.scene.schedule().held()])
        margin = COINCIDENCE * self.scene.drive_period
        times = self.times
        coincide = _near(times, events, margin) & ~_near(times, changes, margin)
        if not coincide.any():
            return Tube(signal, signal, signal)
        around = self.tube(name, COINCIDENCE)
        lower = np.where(coincide, around.lower, signal)
        upper = np.where(coincide, around.upper, signal)
        return Tube(signal, lower, upper)

    def slow_displacement(self, *, averaged: bool = False) -> Array:
        """Return the position averaged over a drive period, by a trajectory or by averages."""
        position = self.averaged_motion.position if averaged else self.signal("position")
        return slow_displacement(self.times, position, self.scene.drive_period)

    @property
    def nothing(self) -> Array:
        """What averaged motion has of events: 0 at each communication point, shape (n,)."""
        return np.zeros_like(self.times)

    def in_run(self, measure: Callable[[Trajectory, Array, DrivePeriods], Any]) -> Any:
        """Return a measure of `period_means` at the communication points."""
        return measure(self.trajectory, self.times, self.scene.drive_periods)

    def at_end(self, measure: Callable[[Trajectory, Array, DrivePeriods], Array | Tube]) -> float:
        """Return a measure of `period_means` at the end of the run."""
        found = measure(self.trajectory, self.times[-1:], self.scene.drive_periods)
        return float((found.middle if isinstance(found, Tube) else found)[0])

    @property
    def last_event_time(self) -> float:
        """The time (s) of the last event, that of the start without any."""
        last = self.at_end(last_events)
        return self.scene.start_time + last * self.scene.drive_period

    @property
    def _simulated_until(self) -> float:
        """The time (s) up to which a reference finds events that coincide with the end."""
        return float(self.times[-1]) + COINCIDENCE * self.scene.drive_period

    def _simulate(self, times: Array) -> Trajectory:
        # What averaged motion comes close to is the full device.
        fidelity = self.device.fidelity or FULL
        device = self.device.tuned([("fidelity", fidelity)])
        *held, last = self.scene.schedule().held()
        return simulate(device, [*held, replace(last, stop=self._simulated_until)], times)

    @cached_property
    def averaged_motion(self) -> AveragedMotion:
        """The averaged motion of the scene, whatever its fidelity, at the communication points."""
        return simulate_averaged(self.device, self.scene.schedule().held(), self.times)

    @property
    def friction_power(self) -> float:
        """The mean power (W) of friction over the last whole drive period of the run."""
        begin, end = self.scene.drive_periods.ends(self.times[-1:])[0].tolist()
        changes = [held.start for held in self.scene.schedule().held()]
        events = np.append(self.trajectory.event_times, changes)
        swings = np.arange(begin, end, tau / self.device.resonator_frequency)
        times, weights = quadrature(np.append(events, swings), begin, end)
        run = self._simulate(times)
        return float(np.sum(weights * run.friction_force * run.velocity) / (end - begin))

    @cached_property
    def steady(self) -> SteadyReferences:
        """The references for the device and the inputs at the start."""
        start = {name: signal.at(0.0) for name, signal in self.scene.signals.items()}
        return SteadyReferences(self.device, **start)

    @cached_property
    def steady_at_end(self) -> SteadyReferences:
        """The references for the device and the inputs at the end of the run."""
        return self._steady_after(self.scene.schedule().held())

    def _steady_after(self, held: Sequence[HeldInputs]) -> SteadyReferences:
        """Return the references for inputs as they are at the end of the last of these.

        The phase (rad) includes the lead of the normal force from earlier frequency ratios.
        """
        now = held[-1].later(held[-1].stop - held[-1].start)
        ratio = now.frequency_ratio
        lead = sum(
            (h.frequency_ratio + 0.5 * h.ratio_rate * (h.stop - h.start) - ratio)
            * self.device.tuned(h.tuned).drive_frequency
            * (h.stop - h.start)
            for h in held
        )
        device = self.device.tuned(now.tuned)
        return SteadyReferences(device, now.phase + lead, now.load, ratio)

    def predictions(self, name: str) -> Array:
        """Return a prediction over the run, by its name, shape (n,); m/s or N."""
        held = self.scene.schedule().held()
        if any(inputs.vary for inputs in held):
            raise ValueError("inputs change between communication points; must be held")
        steady = (self._steady_after(held[: i + 1]) for i in range(len(held)))
        values = np.array([getattr(references, name) for references in steady])
        starts = np.array([inputs.start for inputs in held[1:]])
        return np.asarray(values[np.searchsorted(starts, self.times, side="left")])


def _near(times: Array, instants: Array, margin: float) -> NDArray[np.bool_]:
    """Return for each time (s), shape (n,), whether one of the instants (s) is within a margin."""
    instants = np.append(np.sort(instants), np.inf)
    return np.abs(instants[nearest(instants, times)] - times) <= margin
