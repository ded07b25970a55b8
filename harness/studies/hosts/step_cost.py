"""The cost of a communication step in a C host: set an input, step, get outputs."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import tau
from pathlib import Path
from statistics import median

from slider_resonator.errors import FmuError
from slider_resonator.output.progress import Progress, counted
from studies.hosts.driver_host import ERRORS, PRINTED, SCRIPT, initialised, run_natively
from studies.hosts.job import describe
from studies.hosts.program import run_program


@dataclass(frozen=True)
class Step:
    """A kind of communication step: parameters, its size (s), and how many to take.

    Where the step `exchanges` values, an input is set before it and `outputs` are read after it.
    With several `runs` each one starts from rest, and their median counts.
    """

    name: str
    parameters: Mapping[str, float]
    size: float
    count: int
    outputs: tuple[str, ...]
    exchanges: bool = True
    runs: int = 1


_ALL_MOTION = ("position", "velocity", "mean_velocity", "friction_force")
_FEED_FORWARD = (*_ALL_MOTION, "steady_velocity", "blocking_force")
_FAST = {"drive_frequency": 35000.0, "resonator_frequency": 35000.0, "base_amplitude": 1e-5}

_PERIOD = tau / 3500.0
_PERIODS = 100
ONE_PERIOD = "resolved Coulomb, 1 drive period, no set or get"
LONG_STEP = f"the same, {_PERIODS} drive periods"

_AVERAGED = {"fidelity": 0, "averaging_order": 1}
_LEAPING = {"fidelity": 0, "tolerance": 1e-6}


def _run(name: str, parameters: Mapping[str, float]) -> Step:
    """Ten steps of 2 s from rest; the mean velocity of leaps errs by less than 1e-6 of its peak."""
    return Step(name, parameters, 2.0, 10, (), exchanges=False, runs=41)


STEPS = (
    Step("resolved Coulomb, 1 ms", {"fidelity": 2}, 1e-3, 20_000, _ALL_MOTION),
    Step("the same, steady velocity read too", {"fidelity": 2}, 1e-3, 20_000, _FEED_FORWARD),
    Step("averaged Coulomb, 10 ms", _AVERAGED, 1e-2, 20_000, _ALL_MOTION),
    Step("the same at 35 000 rad/s", {**_AVERAGED, **_FAST}, 1e-2, 20_000, _ALL_MOTION),
    Step("averaged LuGre, 10 ms", {**_AVERAGED, "friction_law": 1}, 1e-2, 20_000, _ALL_MOTION),
    Step("resolved Coulomb at 35 000 rad/s, 10 ms", {**_FAST}, 1e-2, 500, _ALL_MOTION),
    Step("resolved LuGre, 1 ms", {"friction_law": 1}, 1e-3, 5_000, _ALL_MOTION),
    Step(ONE_PERIOD, {"fidelity": 2}, _PERIOD, 100_000, (), exchanges=False),
    Step(LONG_STEP, {"fidelity": 2}, _PERIODS * _PERIOD, 1_000, (), exchanges=False),
    _run("resolved Coulomb from rest, 2 s", {"fidelity": 2}),
    _run("leaping", _LEAPING),
    _run("resolved Coulomb at 35 000 rad/s from rest, 2 s", {"fidelity": 2, **_FAST}),
    _run("leaping at 35 000 rad/s", {**_LEAPING, **_FAST}),
)


@dataclass(frozen=True)
class StepCost:
    """Microseconds of a step with its set and get: median and extremes over the repeats."""

    name: str
    outputs: int
    microseconds: float
    fastest: float
    slowest: float


def measure_steps(
    fmu: Path, repeats: int, progress: Progress, time_limit: float
) -> tuple[StepCost, ...]:
    """Time every kind of step in the C driver, in turn.

    The input that is set is the load, to a new value each time. Raises FmuError with the driver's
    message where it fails or exceeds `time_limit` (s) for one kind.
    """
    times: dict[str, list[float]] = {step.name: [] for step in STEPS}
    for repeat in range(repeats):
        for index, step in enumerate(STEPS):
            done, total = repeat * len(STEPS) + index, repeats * len(STEPS)
            progress(counted(f"C host: {step.name}", done, total), done / total)
            times[step.name].append(_microseconds(fmu, step, time_limit))
    progress("", 1.0)
    return tuple(
        StepCost(s.name, len(s.outputs), median(t), min(t), max(t))
        for s, t in zip(STEPS, times.values(), strict=True)
    )


def _microseconds(fmu: Path, step: Step, time_limit: float) -> float:
    """Return what a step costs in the driver, which is supervised: the median of its runs."""

    def execute(command: Sequence[str], folder: Path) -> str:
        given, printed, errors = (folder / name for name in (SCRIPT, PRINTED, ERRORS))
        return run_program(command, folder, printed, time_limit, script=given, errors=errors)

    try:
        rows = run_natively(fmu, _commands(fmu, step), execute)
    except RuntimeError as error:
        raise FmuError(f"{fmu}: {step.name}: {error}") from error
    if not rows:
        raise FmuError(f"{fmu}: {step.name}: the driver ended before it had taken the steps")
    return median(row[0] for row in rows)


def short_step_ratio(costs: Iterable[StepCost]) -> float:
    """Return the cost of a drive period in steps of one over that in long steps, at the fastest."""
    fastest = {cost.name: cost.fastest for cost in costs}
    return _PERIODS * fastest[ONE_PERIOD] / fastest[LONG_STEP]


def leap_gains(costs: Iterable[StepCost]) -> tuple[float, float]:
    """Return the cost of resolved runs over that of leaps, at 3500 and 35 000 rad/s."""
    fastest = {cost.name: cost.fastest for cost in costs}
    slow, slow_leaps, fast, fast_leaps = (fastest[step.name] for step in STEPS if step.runs > 1)
    return slow / slow_leaps, fast / fast_leaps


def _commands(fmu: Path, step: Step) -> str:
    references = describe(str(fmu)).references
    outputs = " ".join(str(references[name]) for name in step.outputs)
    exchange = f"{references['load']} 0.01 {outputs}" if step.exchanges else ""
    begin = initialised(references, step.parameters)
    timed = f"time {step.count} {step.size!r} {exchange}"
    lines = [*begin, f"step {step.size!r} 10", timed]
    if step.runs > 1:
        lines = [line for _ in range(step.runs) for line in ("reset", *begin, timed)]
    return "\n".join(lines) + "\n"
