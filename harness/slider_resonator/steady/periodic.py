"""The map of an FMU over one common period, and the conditions for a periodic motion."""

from collections.abc import Mapping
from math import isclose, isfinite

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import common_period
from slider_resonator.device.interface import INPUTS, PARAMETERS, VARIABLES
from slider_resonator.errors import FmuError, explained
from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.shooting import STATE, PeriodicRun
from slider_resonator.steady.solvers import NoPeriodicMotion

SLOW = 0.1
"""Distance of the frequency ratio from an integer, below which the phase runs slowly: a beat."""
FIRM = {"normal_preload": 1.0, "normal_amplitude": 0.0, "friction_coefficient": 1e6}
"""Values under which friction shows the deflection of a bristle, whatever it was before."""


def repeating_periods(ratio: float, drive_period: float, max_denominator: int) -> int:
    """Return the number q of drive periods (s) of a common period, for a frequency_ratio p/q.

    Where it is no p/q with a small q there is none, and NoPeriodicMotion is raised: slow_beat next
    to an integer, where the phase runs slowly through all its values, no_common_period elsewhere.
    """
    count = common_period(ratio, max_denominator)
    if count is not None:
        return count
    why = f"no common period: frequency_ratio = {ratio!r} is no p/q with q <= {max_denominator}"
    distance = abs(ratio - round(ratio))
    if distance < SLOW:
        beat = distance / drive_period
        raise NoPeriodicMotion("slow_beat", f"{why}; slow beat at {beat:.6g} Hz")
    raise NoPeriodicMotion("no_common_period", f"{why}; --max-denominator allows a larger q")


class FmuPeriodMap(PeriodicRun):
    """State and load (N) at theta = psi = 0 -> state and displacement (m) after q drive periods.

    An FMU is run with parameters and inputs as `given`. What is in force is read back from it:
    `device`, and by name inputs and its own predictions, `values`. The state has the entries
    `names`: those of `STATE`, with a deflection where there is a LuGre bristle that matters.
    `periods` counts every drive period that has been simulated; `sticks_throughout` says whether
    the slider stuck throughout the last one, as far as rounding tells. Raises FmuError for a drive
    frequency without drive periods, and as `Instance.start` does.
    """

    def __init__(self, instance: Instance, given: Mapping[str, float]) -> None:
        self.instance = instance
        self.given = given
        instance.start(given)
        parameters = [name for name in PARAMETERS if name in instance.fmu.variables]
        names = [*INPUTS, "steady_velocity", "blocking_force"]
        names += ["prediction_valid"] if "prediction_valid" in instance.fmu.variables else []
        with instance.explained():
            device, self.values = instance.read(parameters), instance.read(names)
        device["drive_frequency"] *= 1.0 + given.get("frequency_deviation", 0.0)
        with explained(f"{instance.fmu.path.name} reports ", FmuError):
            VARIABLES["drive_frequency"].read(device["drive_frequency"])
        self.device = Device().tuned(device.items())
        self.phase, self.ratio = self.values["phase"], self.values["frequency_ratio"]
        self.periods = 0
        self.sticks_throughout = False
        # Averaged motion keeps no bristle.
        is_lugre = self.device.friction_law == 1 and self.device.fidelity != 0
        self.bends = is_lugre and self.friction > 0.0 and self.device.bristle_stiffness > 0.0
        self.names = STATE if self.bends else STATE[:3]
        self._read = instance.block(["position", *STATE[:3], "stick_fraction"])

    def run(self, state: Array, load: float, periods: int, samples: int = 1) -> tuple[Array, Array]:
        """Return states and travel; the deflection of a bristle is that at the end throughout."""
        initial = zip((f"initial_{name}" for name in self.names), state.tolist(), strict=True)
        self.instance.start({**self.given, **dict(initial), "load": load})
        read, end = [self._read.read()], periods * self.drive_period
        with self.instance.explained():
            for sample in range(1, samples + 1):
                self.instance.step_to(sample / samples * end)
                read.append(self._read.read())
        if not np.isfinite(read).all():
            raise FmuError(
                f"{self.instance.fmu.path.name} at t = {end:.9g} s: output is {read[-1]}"
            )
        self.periods += periods
        self.sticks_throughout = abs(read[-1][4] - 1.0) <= 1e-10
        rows = np.array(read)
        states, travel = rows[1:, 1:4], rows[1:, 0] - rows[0, 0]
        if self.bends:
            states = np.column_stack([states, np.full(samples, self._deflection())])
        return states, travel

    def _deflection(self) -> float:
        """Return the deflection z (m) of the bristle, and end the run.

        Tuned to a `FIRM` contact, friction is faces N (s0 z + s1 (v - |v| s0 z / mu)), (8), nearly
        faces N (s0 z + s1 v).
        """
        with self.instance.explained():
            self.instance.set(FIRM)
            read = self.instance.read(["friction_force", "normal_force", "velocity"])
        friction, normal, velocity = read.values()
        if not (isclose(normal, FIRM["normal_preload"]) and isfinite(friction)):
            raise FmuError(
                f"{self.instance.fmu.path.name} at t = {self.instance.time:.9g} s: normal_force = "
                f"{normal!r} N must be the normal_preload of {FIRM['normal_preload']!r} N just "
                f"set, and friction_force = {friction!r} N finite"
            )
        damping = self.device.bristle_damping
        held = friction / (self.device.friction_faces * normal) - damping * velocity
        weight = 1.0 - damping * abs(velocity) / FIRM["friction_coefficient"]
        return held / (weight * self.device.bristle_stiffness)
