"""What methods without located events share: held inputs one after the other, and samples."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, check_contiguous, check_times
from slider_resonator.references.resolved.contact import LIFTED
from slider_resonator.references.resolved.equations import equations_of, initial_state
from slider_resonator.references.resolved.recorder import Recorder
from slider_resonator.references.resolved.trajectory import Trajectory


class RunWithoutEvents(ABC):
    """A device followed through held inputs; ``theta`` and ``psi`` (rad) are those at their start.

    ``state`` holds position, velocity, resonator displacement and velocity, shape (4,).
    """

    def __init__(self, device: Device, times: Array) -> None:
        self.recorder = Recorder(times)
        self.equations = equations_of(device)
        self.state: Array = np.array(initial_state(device))
        self.theta = 0.0
        self.psi = 0.0

    def run(self, held: Sequence[HeldInputs]) -> Trajectory:
        """Return the motion through the held inputs.

        ``contact_mode`` is the sign of the velocity (2 where the contact is open), ``reversals``
        counts its changes of sign between steps; there are no event times. Raises ValueError for
        inputs with gaps and times outside them, besides what the method raises.
        """
        check_contiguous(held)
        check_times(self.recorder.times, held)
        for inputs in held:
            self.follow(inputs)
            turned = self.equations.drive_frequency * (inputs.stop - inputs.start)
            self.theta += turned
            self.psi += inputs.frequency_ratio * turned
        return self.recorder.trajectory()

    @abstractmethod
    def follow(self, inputs: HeldInputs) -> None:
        """Advance ``state`` through held inputs, keeping samples and counts."""

    def angles(self, inputs: HeldInputs, local: Array) -> Array:
        """Return psi + phase in rad at times in s since the start of the inputs, shape (k,)."""
        rate = inputs.frequency_ratio * self.equations.drive_frequency
        return np.asarray(self.psi + inputs.phase + rate * local)

    def keep(self, inputs: HeldInputs, local: Array, states: Array, friction: Array) -> None:
        """Keep states (k, 4) and friction (k,) in N at times in s since the start of the inputs."""
        equations = self.equations
        angles = self.angles(inputs, local)
        load = equations.normal_preload + equations.normal_amplitude * np.sin(angles)
        self.recorder.keep(
            states,
            equations.resonator_motion(self.theta + equations.drive_frequency * local, states),
            (np.maximum(0.0, load), friction),
            np.where(load > 0.0, np.sign(states[:, 1]), float(LIFTED)),
        )
