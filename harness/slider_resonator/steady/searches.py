"""Find steady velocity and blocking force of an FMU by shooting, without a long run."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isclose, isfinite
from typing import Any, ClassVar, TypeVar

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import DEVIATIONS, Device
from slider_resonator.device.drive_periods import MAX_DENOMINATOR, common_period
from slider_resonator.device.interface import INPUTS, PARAMETERS, VARIABLES
from slider_resonator.errors import FmuError, HarnessError, explained
from slider_resonator.fmu.instance import Instance
from slider_resonator.output.readable import number_of, one_line, readable
from slider_resonator.output.shown import Shown
from slider_resonator.steady.shooting import (
    STATE,
    FixedPoint,
    NoPeriodicMotion,
    PeriodicRun,
    blocked_point,
    steady_point,
)

Result = TypeVar("Result", bound="SearchResult")

DEPARTURES = {
    "stable": "decay",
    "unstable": "grow: another motion is reached in practice",
    "neutral": "neither grow nor decay",
}
"""What small departures from a motion do, by its stability."""
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


@dataclass(frozen=True, repr=False)
class SearchResult(Shown):
    """Status, reason and cost of a search.

    What is `searched` is a field, in `unit`; `settled` is the status where it is found and stable.
    `status` is for machines, `reason` for people; `predicted` is the FMU's own output and
    `prediction_valid` what the FMU says of it, None where it has no such output. `inputs` are those
    that were held, in SI units, deviations only where not 0, with friction on `friction_faces`.
    The common period has `common_period` drive periods; `periods` counts all simulated ones.
    `multipliers` are the Floquet multipliers, largest first, `residual` the largest change of the
    state over the common period in units of its scale.
    """

    searched: ClassVar[str]
    unit: ClassVar[str]
    settled: ClassVar[str]
    held: ClassVar[Sequence[str]] = tuple(INPUTS)
    status: str
    reason: str
    predicted: float
    prediction_valid: bool | None
    inputs: Mapping[str, float]
    friction_faces: int
    common_period: int | None = None
    periods: int = 0
    iterations: int = 0
    residual: float | None = None
    multipliers: tuple[complex, ...] = ()
    stable: bool | None = None

    @property
    def value(self) -> float | None:
        """What was searched, None where there is none."""
        found: float | None = getattr(self, self.searched)
        return found

    def describe(self) -> list[str]:
        """Return the answer, why it is one, and what it cost."""
        what = self.searched.replace("_", " ")
        found = "none" if self.value is None else f"{readable(self.value, 10)} {self.unit}"
        how = "read without a run"
        if self.prediction_valid is False:
            how += "; the FMU says that it does not hold here: prediction_valid = 0"
        rows = {
            what: found,
            "status": f"{self.status}: {one_line(self.reason)}",
            "FMU's output": f"{readable(self.predicted, 10)} {self.unit} ({how})",
        }
        if self.common_period is not None:
            periods, count = number_of(self.periods, "drive period"), self.common_period
            iterations = number_of(self.iterations, "iteration")
            rows["cost"] = f"{periods} in {iterations}, a common period is {count} of them"
        if self.multipliers:
            sizes = ", ".join(f"{abs(multiplier):.6f}" for multiplier in self.multipliers)
            rows["multipliers"] = f"{sizes} (magnitudes)"
        rows["inputs"] = ", ".join(
            f"{name} {readable(value, 6)} {VARIABLES[name].unit}".removesuffix(" 1")
            for name, value in self.inputs.items()
        )
        rows["friction"] = f"on {number_of(self.friction_faces, 'face')} (friction_faces)"
        return [f"{label:<17}{text}" for label, text in rows.items()]


@dataclass(frozen=True, repr=False)
class SteadyMotion(SearchResult):
    """The result of a search for steady motion.

    `steady_velocity` (m/s) is the mean over the common period, None where there is no steady
    motion; `state` is the one at theta = psi = 0. `status` is steady, stuck, unstable or neutral;
    without a velocity it is load_above_friction, slow_beat (frequency_ratio next to an integer),
    no_common_period, no_fixed_point, not_unique or not_converged.
    """

    searched, unit, settled = "steady_velocity", "m/s", "steady"
    steady_velocity: float | None = None
    state: Mapping[str, float] = field(default_factory=dict)


def find_steady(
    instance: Instance, values: Mapping[str, float], *, max_denominator: int = MAX_DENOMINATOR
) -> SteadyMotion:
    """Find the steady motion of an FMU with the given parameters and inputs.

    An `initial_velocity` among the values is where the search begins, otherwise that is the FMU's
    own prediction. Raises FmuError and Refusal as `Instance.start` does.
    """
    run = FmuPeriodMap(instance, values)
    runaway = _runaway(run)
    try:
        # Damped bristles can give more friction than full sliding: only the search can decide.
        if runaway is not None and run.device.friction_law == 0:
            raise runaway
        run.drive_periods = repeating_periods(run.ratio, run.drive_period, max_denominator)
        guess = values.get("initial_velocity", run.values["steady_velocity"])
        found = steady_point(run, guess if isfinite(guess) else 0.0, run.values["load"])
    except NoPeriodicMotion as none:
        if run.drive_periods and runaway is not None:
            none.status, none.reason = runaway.status, runaway.reason
        return _result(SteadyMotion, run, none)
    velocity = found.displacement / run.period
    state = dict(zip(run.names, found.state.tolist(), strict=True))
    motion = _result(SteadyMotion, run, found, steady_velocity=velocity, state=state)
    if not run.sticks_throughout:
        return motion
    reason = "the slider sticks throughout: the drive does not overcome friction"
    return replace(motion, status="stuck", reason=reason)


def _runaway(run: FmuPeriodMap) -> NoPeriodicMotion | None:
    """Return the refusal of a load that even full sliding friction cannot hold."""
    load, limit = run.values["load"], run.friction
    if abs(load) < limit or (load == 0.0 and limit == 0.0):
        return None
    rate = (abs(load) - limit) / run.device.total_mass
    return NoPeriodicMotion(
        "load_above_friction",
        f"no steady motion: load = {load:.6g} N is not below the {limit:.6g} N that friction "
        f"gives on average in full sliding; the slider gains {rate:.3g} m/s every second",
    )


@dataclass(frozen=True, repr=False)
class Blocking(SearchResult):
    """The result of a search for the blocking force.

    `blocking_force` (N) is None where there is none. `status` is blocked, unstable or neutral;
    without a force it is stuck, slow_beat (frequency_ratio next to an integer), no_common_period,
    no_fixed_point, not_unique or not_converged.
    """

    searched, unit, settled = "blocking_force", "N", "blocked"
    held = ("phase", "frequency_ratio")
    blocking_force: float | None = None


def refuse_load(values: Mapping[str, object]) -> None:
    """Raise HarnessError for a load among the values: the search is for the load."""
    if "load" in values:
        raise HarnessError(
            f"load = {values['load']!r}: it is what is searched; must be another parameter or input"
        )


def find_blocking(
    instance: Instance, values: Mapping[str, float], *, max_denominator: int = MAX_DENOMINATOR
) -> Blocking:
    """Find the load that stops an FMU with the given parameters and inputs, but their load.

    The search begins where the FMU predicts it. Errors are those of `find_steady`.
    """
    run = FmuPeriodMap(instance, {name: v for name, v in values.items() if name != "load"})
    predicted = run.values["blocking_force"]
    load = predicted if isfinite(predicted) else 0.0
    try:
        run.drive_periods = repeating_periods(run.ratio, run.drive_period, max_denominator)
        guess, scale = run.warm_up(0.0, load)
        if run.sticks_throughout:
            sticks = f"the slider sticks throughout at load = {load:.6g} N"
            raise NoPeriodicMotion("stuck", f"{sticks}: every load that friction holds stops it")
        load, found = blocked_point(run, guess, scale, load, max(run.friction, 1e-12))
    except NoPeriodicMotion as none:
        return _result(Blocking, run, none)
    return _result(Blocking, run, found, blocking_force=load)


def _result(
    kind: type[Result], run: FmuPeriodMap, found: FixedPoint | NoPeriodicMotion, **answer: Any
) -> Result:
    """Return the result of a search, with the answer by name where something was `found`."""
    if isinstance(found, FixedPoint):
        stable, largest = found.stability == "stable", f"{abs(found.multipliers[0]):.9g}"
        status = kind.settled if stable else found.stability
        departures = f"departures from this motion {DEPARTURES[found.stability]}"
        reason = f"{departures}; the largest multiplier is {largest}"
        answer |= {"multipliers": tuple(found.multipliers.tolist()), "stable": stable}
    else:
        status, reason = found.status, found.reason
    undecided = ("neutral", "not_converged", "no_fixed_point", "not_unique")
    if status in undecided and run.device.damping_ratio == 0.0:
        reason += " (damping_ratio = 0: the transient of the resonator never decays)"
    valid = run.values.get("prediction_valid")
    return kind(
        *(status, reason, run.values[kind.searched], None if valid is None else valid == 1.0),
        {name: run.values[name] for name in kind.held}
        | {name: run.given[name] for name in DEVIATIONS if run.given.get(name)},
        int(run.device.friction_faces),
        common_period=run.drive_periods or None,
        periods=run.periods,
        iterations=found.iterations,
        residual=found.residual,
        **answer,
    )


SEARCHES: Mapping[str, Callable[..., SearchResult]] = {
    "steady_velocity": find_steady,
    "blocking_force": find_blocking,
}
"""The search for each steady quantity, which is an attribute of its result, None where none is."""


@dataclass(frozen=True)
class SteadyAnswer:
    """An answer (m/s or N), None with a `reason` where there is none, and its CPU time (s).

    `periods` are the drive periods simulated.
    """

    seconds: float
    value: float | None
    reason: str = ""
    periods: int = 0
