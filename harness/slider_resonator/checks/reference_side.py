"""The references in a scene: trajectories, steady motion, closed forms, each computed once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from math import pi
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.measures.tube import Tube
from slider_resonator.checks.period_means import (
    COINCIDENCE,
    DriveTurns,
    last_events,
    mean_velocities,
    stick_fractions,
)
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references import closed_forms
from slider_resonator.references.averaged import (
    averaged_coulomb,
    prediction_validity,
    uniform_average,
)
from slider_resonator.references.averaged.averaged_motion import AveragedMotion, simulate_averaged
from slider_resonator.references.averaged.averaged_outputs import (
    AveragedOutputs,
    averaged_outputs,
)
from slider_resonator.references.averaged.motion_from_start import (
    MotionFromStart,
    simulate_from_start,
)
from slider_resonator.references.resolved import located_events, lugre_scipy, taylor
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.scenes.scene import Scene
from slider_resonator.steady.reference_steady import (
    reference_blocking_force,
    reference_steady_velocity,
)

_SIMULATORS: Mapping[str, Callable[..., Trajectory]] = {
    "located_events": located_events.simulate,
    "taylor": taylor.simulate,
    "bristle_state": lugre_scipy.simulate_lugre,
}

FULL = 2
"""Fidelity of the full device."""

TUBE_POINTS = 3
"""Points on each side of a time at which a tube samples the reference."""


class ReferenceSide:
    """Trajectories, steady motion and closed forms for one scene, computed on first use.

    Steady motion and closed forms are for constant `inputs` by name (rad, N, 1) and a `device`, by
    default those at the start.
    """

    def __init__(
        self,
        scene: Scene,
        inputs: Mapping[str, float] | None = None,
        device: Device | None = None,
    ) -> None:
        self.scene = scene
        self.device = device or scene.device
        start = {name: signal.at(0.0) for name, signal in scene.signals.items()}
        self.inputs = start if inputs is None else inputs
        self._trajectories: dict[str, Trajectory] = {}
        self._around: dict[tuple[str, float], Trajectory] = {}

    @property
    def drive_period(self) -> float:
        """Drive period in seconds."""
        return self.scene.drive_period

    @cached_property
    def times(self) -> Array:
        """Times of the scene (s) at which outputs are read, shape (n,)."""
        return self.scene.schedule().readings()

    def trajectory(self, reference: str) -> Trajectory:
        """Return the trajectory of `located_events`, `taylor` or, for LuGre, `bristle_state`.

        Its times are the communication points and the ends of drive periods that means need.
        """
        if reference not in self._trajectories:
            every = any(expect.quantity == "mean_velocity_in_run" for expect in self.scene.expect)
            means = self.times if every else self.times[-1:]
            times = np.union1d(self.times, self.turns.ends(means))
            self._trajectories[reference] = self._simulate(reference, times)
        return self._trajectories[reference]

    def signal(self, reference: str, name: str) -> Array:
        """Return one output of a trajectory at the communication points, shape (n,)."""
        run = self.trajectory(reference)
        values = np.asarray(getattr(run, name), dtype=np.float64)
        return values[np.searchsorted(run.time, self.times)]

    def tube(self, reference: str, name: str, share: float) -> Tube:
        """Return one output with its range within a share of a drive period to each side."""
        offsets = share * self.drive_period * np.linspace(-1.0, 1.0, 2 * TUBE_POINTS + 1)
        around = np.clip(self.times[:, None] + offsets, 0.0, self._simulated_until)
        if (reference, share) not in self._around:
            self._around[reference, share] = self._simulate(reference, np.unique(around))
        run = self._around[reference, share]
        values = np.asarray(getattr(run, name), dtype=np.float64)
        window = values[np.searchsorted(run.time, around)]
        return Tube(window[:, TUBE_POINTS], window.min(axis=1), window.max(axis=1))

    def reversals(self, reference: str) -> int:
        """Return the number of reversals up to the end."""
        run = self.trajectory(reference)
        return run.reversals - int(np.sum(run.reversal_times > self.times[-1]))

    def in_run(
        self, reference: str, measure: Callable[[Trajectory, Array, DriveTurns], Any]
    ) -> Any:
        """Return a measure of `period_means` at the communication points."""
        return measure(self.trajectory(reference), self.times, self.turns)

    def last_event_time(self, reference: str) -> float:
        """Return the time (s) of the last event, that of the start without any."""
        run, end = self.trajectory(reference), self.times[-1:]
        last = float(last_events(run, end, self.turns).middle[0])
        return self.scene.start_time + last * self.drive_period

    @property
    def _simulated_until(self) -> float:
        """The time (s) up to which a reference finds events that coincide with the end."""
        return float(self.times[-1]) + COINCIDENCE * self.drive_period

    def _simulate(self, reference: str, times: Array) -> Trajectory:
        # What averaged motion comes close to is the full device.
        fidelity = self.device.fidelity or FULL
        device = replace(self.device, fidelity=fidelity)
        *held, last = self.scene.schedule().held()
        inputs = [*held, replace(last, stop=self._simulated_until)]
        return _SIMULATORS[reference](device, inputs, times)

    @cached_property
    def averaged_motion(self) -> AveragedMotion:
        """The averaged motion of the scene, whatever its fidelity, at the communication points."""
        return simulate_averaged(self.device, self.scene.schedule().held(), self.times)

    @cached_property
    def averaged_outputs(self) -> AveragedOutputs:
        """Resonator, contact and forces of the averaged motion, at the communication points."""
        return averaged_outputs(self.device, self.scene.schedule().held(), self.averaged_motion)

    @cached_property
    def _on_held_orbits(self) -> MotionFromStart:
        """The motion of second order at the communication points and the ends of turns."""
        times = np.union1d(self.times, self.turns.ends(self.times))
        return simulate_from_start(self.device, self.scene.schedule().held(), times)

    def on_held_orbits(self, name: str) -> Array:
        """Return an output of the motion of second order at the communication points."""
        run = self._on_held_orbits
        return np.asarray(getattr(run, name)[np.searchsorted(run.time, self.times)])

    @property
    def mean_velocities_on_held_orbits(self) -> Array:
        """Mean velocities (m/s) of `period_means` at the communication points, shape (n,)."""
        return mean_velocities(self._on_held_orbits, self.times, self.turns)

    def centre_velocity(self, signal: Callable[[str], Array]) -> Array:
        """Return X' + r Y' (m/s) of the signals of a reference by name, shape (n,)."""
        return signal("velocity") + self.device.mass_ratio * signal("resonator_velocity")

    def mean_velocity(self, reference: str) -> float:
        """Return the mean velocity (m/s) over the last whole drive period of the run."""
        run, end = self.trajectory(reference), self.times[-1:]
        return float(mean_velocities(run, end, self.turns)[0])

    def stick_fraction(self, reference: str) -> float:
        """Return the share of the last whole drive period of the run that is spent sticking."""
        run, end = self.trajectory(reference), self.times[-1:]
        return float(stick_fractions(run, end, self.turns)[0])

    @cached_property
    def steady_velocity(self) -> float | None:
        """Mean velocity (m/s) of the steady motion, by shooting with located events."""
        try:
            guess = self.predicted_velocity
        except ValueError:
            guess = 0.0
        inputs = (self.inputs["phase"], self.inputs["load"], self.inputs["frequency_ratio"])
        return reference_steady_velocity(self.device, *inputs, guess)

    @cached_property
    def blocking_force(self) -> float | None:
        """Load (N) that makes the mean velocity zero, by shooting with located events."""
        phase, ratio = self.inputs["phase"], self.inputs["frequency_ratio"]
        return reference_blocking_force(self.device, phase, ratio)

    @property
    def full_device(self) -> ReferenceSide:
        """The references for the full device, whatever the fidelity of the scene."""
        return ReferenceSide(self.scene, self.inputs, replace(self.device, fidelity=FULL))

    @property
    def predicted_velocity(self) -> float:
        """Steady velocity (m/s) of averaged motion: any ratio, both laws, with lift-off."""
        phase, load = self.inputs["phase"], self.inputs["load"]
        ratio = self.inputs["frequency_ratio"]
        if self.device.friction_law == 1:
            return uniform_average.device_steady_velocity(self.device, phase, load, ratio)
        return averaged_coulomb.device_steady_velocity_at_ratio(self.device, phase, ratio, load)

    @property
    def predicted_blocking_force(self) -> float:
        """Blocking force (N) of averaged motion, as for `predicted_velocity`."""
        phase, ratio = self.inputs["phase"], self.inputs["frequency_ratio"]
        if self.device.friction_law == 1:
            return uniform_average.device_blocking_force(self.device, phase, ratio)
        return averaged_coulomb.device_blocking_force_at_ratio(self.device, phase, ratio)

    @property
    def prediction_valid(self) -> float:
        """1 where averaged theory applies, 0 where not."""
        phase, load = self.inputs["phase"], self.inputs["load"]
        ratio = self.inputs["frequency_ratio"]
        valid = prediction_validity.prediction_valid(self.device, phase, load, ratio)
        return 1.0 if valid else 0.0

    @property
    def at_the_end(self) -> ReferenceSide:
        """The device and the inputs at the end of the run, as constant ones."""
        return self._under(self.scene.schedule().held())

    def _under(self, held: Sequence[HeldInputs]) -> ReferenceSide:
        """Return the references for inputs as they are at the end of the last of these.

        The phase (rad) includes the lead of the normal force from earlier frequency ratios.
        """
        now = held[-1].later(held[-1].stop - held[-1].start)
        ratio = now.frequency_ratio
        lead = sum(
            (h.frequency_ratio + 0.5 * h.ratio_rate * (h.stop - h.start) - ratio)
            * _drive_frequency(h, self.device)
            * (h.stop - h.start)
            for h in held
        )
        inputs = {"phase": now.phase + lead, "load": now.load, "frequency_ratio": ratio}
        return ReferenceSide(self.scene, inputs, now.tuned_device(self.scene.device))

    def predictions(self, name: str) -> Array:
        """Return a prediction over the run, by its name, shape (n,); m/s or N."""
        held = self.scene.schedule().held()
        if any(inputs.vary for inputs in held):
            raise ValueError("inputs change between communication points; must be held")
        values = np.array([getattr(self._under(held[: i + 1]), name) for i in range(len(held))])
        starts = np.array([inputs.start for inputs in held[1:]])
        return np.asarray(values[np.searchsorted(starts, self.times, side="left")])

    @property
    def averaged_velocity(self) -> float:
        """Steady velocity (m/s) of averaged theory, (5) and (20); for equal frequencies only."""
        self._require_equal_frequencies()
        phase, load = self.inputs["phase"], self.inputs["load"]
        return closed_forms.device_steady_velocity(self.device, phase, load)

    @property
    def averaged_blocking_force(self) -> float:
        """Blocking force (N) of averaged theory, (22) for all faces; for equal frequencies only."""
        self._require_equal_frequencies()
        return closed_forms.device_blocking_force(self.device, self.inputs["phase"])

    @property
    def ripple_amplitude(self) -> float:
        """Amplitude (m) of the fast displacement, (33)-(34)."""
        return closed_forms.equivalent_force(self.device).ripple_amplitude

    @property
    def difference_frequency(self) -> float:
        """Distance (Hz) of the normal force's frequency from a multiple of the drive's: the beat.

        For a ratio near 1 it is that of appendix A.
        """
        ratio = self.inputs["frequency_ratio"]
        return abs(ratio - round(ratio)) / self.drive_period

    @cached_property
    def turns(self) -> DriveTurns:
        """The whole turns of the drive."""
        if not self.scene.tuning:
            return DriveTurns(self.drive_period)
        held = self.scene.schedule().held()
        rates = [_drive_frequency(inputs, self.device) for inputs in held]
        turned = [r * (h.stop - h.start) / (2.0 * pi) for r, h in zip(rates, held, strict=True)]
        times = (held[0].start, *(inputs.stop for inputs in held))
        return DriveTurns(self.drive_period, times, (0.0, *np.cumsum(turned).tolist()))

    def _require_equal_frequencies(self) -> None:
        ratio = self.inputs["frequency_ratio"]
        if ratio != 1.0:
            raise ValueError(f"frequency_ratio = {ratio!r}: the closed form allows only 1")


def _drive_frequency(inputs: HeldInputs, device: Device) -> float:
    return inputs.tuned_device(device).drive_frequency
