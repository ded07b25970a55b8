"""The map of an FMU over one common period, and what must hold before anything can repeat."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import asin, ceil, isfinite, pi, sin, sqrt

import numpy as np

from harness.common_period import common_period
from harness.drive import Instance
from harness.errors import FmuError
from harness.newton import Vector

STATE = ("velocity", "resonator_displacement", "resonator_velocity")
"""The state at theta = psi = 0; the position does not matter, for nothing depends on it."""
INITIAL = tuple(f"initial_{name}" for name in STATE)
WARM_UP = 20
"""Drive periods run before shooting, so that the resonator's own transient is mostly gone."""
SAMPLES = 8
"""Points of the last drive period of the warm-up that give the size of each state."""
SLOW = 0.1
"""Distance of the frequency ratio from an integer, below which the phase runs slowly: a beat."""


@dataclass(frozen=True)
class Obstacle:
    """Why nothing repeats; `status` for machines, `reason` for people."""

    status: str
    reason: str


@dataclass(frozen=True)
class Facts:
    """Parameters and inputs in force, read back from the FMU, and its own two predictions."""

    values: Mapping[str, float]
    steady_velocity: float
    blocking_force: float

    def __getitem__(self, name: str) -> float:
        """Return a parameter or input by name."""
        return self.values[name]

    @property
    def drive_period(self) -> float:
        """Seconds that theta takes for one turn."""
        return 2.0 * pi / self["drive_frequency"]

    @property
    def mean_normal_force(self) -> float:
        """Normal force (N) of a face averaged over the drive, with lift-off."""
        preload, amplitude = self["normal_preload"], self["normal_amplitude"]
        if self["frequency_ratio"] == 0.0:
            return max(0.0, preload + amplitude * sin(self["phase"]))
        if amplitude <= preload:
            return preload
        share = preload / amplitude
        return preload * (0.5 + asin(share) / pi) + amplitude / pi * sqrt(1.0 - share**2)

    @property
    def friction_limit(self) -> float:
        """Mean friction force (N) of a slider that slides one way all the time."""
        return self["friction_faces"] * self["friction_coefficient"] * self.mean_normal_force

    @property
    def velocity_floor(self) -> float:
        """Velocity (m/s) that friction takes away in a drive period; a scale where all rests."""
        mass = self["slider_mass"] + self["resonator_mass"]
        return max(self.friction_limit / mass * self.drive_period, 1e-9)


def read_facts(instance: Instance, values: Mapping[str, float]) -> Facts:
    """Initialise the FMU with `values` and read back what is in force."""
    instance.start(values)
    names = (
        *("phase", "load", "frequency_ratio", "drive_frequency", "normal_preload"),
        *("normal_amplitude", "friction_faces", "friction_coefficient", "friction_law"),
        *("slider_mass", "resonator_mass", "damping_ratio"),
    )
    with instance.explained():
        read = {name: instance.value(name) for name in names}
        predictions = instance.value("steady_velocity"), instance.value("blocking_force")
    return Facts(read, *predictions)


def repeating_periods(facts: Facts, max_denominator: int) -> int | Obstacle:
    """Return the number q of drive periods of a common period.

    Where frequency_ratio is no p/q with a small q nothing repeats: slow_beat next to an integer,
    where the phase runs slowly through all its values, no_common_period elsewhere.
    """
    ratio = facts["frequency_ratio"]
    count = common_period(ratio, max_denominator)
    if count is not None:
        return count
    why = f"no common period: frequency_ratio = {ratio!r} is no p/q with q <= {max_denominator}"
    distance = abs(ratio - round(ratio))
    if distance < SLOW:
        beat = distance / facts.drive_period
        return Obstacle("slow_beat", f"{why}; slow beat at {beat:.6g} Hz")
    return Obstacle(
        "no_common_period",
        f"{why}, so that drive and normal force never repeat together; --max-denominator allows "
        "a larger q",
    )


def hidden_state(facts: Facts) -> Obstacle | None:
    """Return the obstacle of a friction law with a state that the interface does not show."""
    if facts["friction_law"] == 0:
        return None
    return Obstacle(
        "hidden_state",
        f"friction_law = {facts['friction_law']:.0f} has a bristle deflection that no output "
        "shows, so that the state over a period cannot be closed; allowed is 0 (Coulomb)",
    )


class FmuPeriodMap:
    """State and load (N) at theta = psi = 0 -> state and displacement (m) after q drive periods.

    `periods` counts every drive period that has been simulated, `stick_fraction` is that of the
    last one.
    """

    def __init__(
        self, instance: Instance, values: Mapping[str, float], facts: Facts, drive_periods: int
    ) -> None:
        self.instance = instance
        self.values = values
        self.facts = facts
        self.drive_periods = drive_periods
        self.periods = 0
        self.stick_fraction = 0.0
        self._read = instance.block(["position", *STATE, "stick_fraction"])

    @property
    def period(self) -> float:
        """Length of the common period in seconds."""
        return self.drive_periods * self.facts.drive_period

    def __call__(self, state: Vector, load: float) -> tuple[Vector, float]:
        """Run one common period."""
        before = self._start(state, load)
        after = self._advance(self.period, self.drive_periods)
        return np.array(after[1:4]), after[0] - before

    def warm_up(self, velocity: float, load: float) -> tuple[Vector, Vector, float]:
        """Run some periods with the resonator at rest and the slider at `velocity` (m/s).

        Returns the state at the end, the typical size of each state, and the mean velocity over
        the last drive period.
        """
        count = ceil(WARM_UP / self.drive_periods) * self.drive_periods
        period = self.facts.drive_period
        self._start(np.array([velocity, 0.0, 0.0]), load)
        position = self._advance((count - 1) * period, count - 1)[0]
        samples = []
        for index in range(1, SAMPLES + 1):
            samples.append(self._advance((count - 1 + index / SAMPLES) * period, 0))
        self.periods += 1
        sizes = np.abs(np.array(samples)[:, 1:4]).max(axis=0)
        floor = self.facts.velocity_floor
        scale = np.maximum(sizes, [floor, floor * period / (2.0 * pi), floor])
        end = samples[-1]
        return np.array(end[1:4]), scale, (end[0] - position) / period

    def _start(self, state: Vector, load: float) -> float:
        initial = dict(zip(INITIAL, map(float, state), strict=True))
        self.instance.start({**self.values, **initial, "load": load})
        return self._read.read()[0]

    def _advance(self, time: float, periods: int) -> list[float]:
        with self.instance.explained():
            self.instance.step_to(time)
            read = self._read.read()
        self.periods += periods
        self.stick_fraction = read[4]
        if not all(isfinite(value) for value in read):
            raise FmuError(f"{self.instance.fmu.path.name} at t = {time:.9g} s: output is {read}")
        return read
