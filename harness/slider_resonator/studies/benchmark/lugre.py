"""What a drive period of LuGre friction costs, at equal error and for stiff bristles."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.resolved.lugre_taylor import simulate_lugre
from slider_resonator.studies.benchmark import coulomb
from slider_resonator.studies.benchmark.cost import (
    Cost,
    Method,
    Outcome,
    Ratio,
    cheapest_within,
    measure,
    ratio,
)
from slider_resonator.studies.benchmark.coulomb import PERIOD, switching_outcome
from slider_resonator.studies.benchmark.fmu_method import parameters, run_fmu
from slider_resonator.studies.benchmark.in_turn import Progress
from slider_resonator.studies.trade.peers.lugre_cvode import simulate_lugre_cvode
from slider_resonator.studies.trade.peers.switching_taylor import SlidingEnd, simulate_sliding

EQUAL_ERROR = 1e-8
"""Error, over the peaks, at which costs are compared."""

TOLERANCES = (1e-7, 1e-8, 1e-9, 1e-10)


@dataclass(frozen=True)
class Case:
    """A bristle stiffness (1/m), and the drive periods that each method follows."""

    stiffness: float
    fmu_periods: int
    periods: int
    state_periods: int
    cvode_periods: int


CASES = (Case(1e5, 200, 100, 20, 2), Case(1e8, 200, 100, 1, 2))


@dataclass(frozen=True)
class LugreBenchmark:
    """All costs at one stiffness, and ratios of each peer to each FMU at EQUAL_ERROR.

    `most_exact_of_the_others` are those of methods that were never that exact; they stand in
    `ratios` too.
    """

    stiffness: float
    repeats: int
    costs: tuple[Cost, ...]
    ratios: tuple[Ratio, ...]
    most_exact_of_the_others: tuple[Cost, ...]


def measure_lugre(
    instances: Mapping[str, Instance], case: Case, repeats: int, progress: Progress
) -> LugreBenchmark:
    """Run everything `repeats` times; HarnessError without heyoka or scikit-sundae."""
    device = replace(coulomb.DEVICE, friction_law=1, bristle_stiffness=case.stiffness)
    groups = {
        **{name: _fmu(instance, device, case) for name, instance in instances.items()},
        "heyoka, bristle from path": _heyoka(device, "path", case.periods),
        "heyoka, bristle as state": _heyoka(device, "state", case.state_periods),
        "CVODE BDF, bristle as state": _cvode(device, case.cvode_periods),
    }
    methods = [
        Method(f"{name}, tol {tolerance:.0e}", periods, partial(run, tolerance))
        for name, (periods, run) in groups.items()
        for tolerance in TOLERANCES
    ]
    try:
        referee = _referee(device, max(case.fmu_periods, case.periods))
        costs = measure(methods, referee, device, repeats, progress)
    except ModuleNotFoundError as error:
        raise HarnessError(str(error)) from error
    best: dict[str, Cost] = {}
    others = []
    for name in groups:
        tried = [cost for cost in costs if cost.method.startswith(name + ",")]
        exact = cheapest_within(tried, EQUAL_ERROR)
        best[name] = exact or min(tried, key=lambda cost: cost.velocity_error or 0.0)
        if exact is None:
            others.append(best[name])
    ratios = [
        ratio(best[peer], best[ours])
        for ours in instances
        for peer in groups
        if peer not in instances
    ]
    return LugreBenchmark(case.stiffness, repeats, costs, tuple(ratios), tuple(others))


Run = Callable[[float], Outcome]


def _fmu(instance: Instance, device: Device, case: Case) -> tuple[int, Run]:
    def run(tolerance: float) -> Outcome:
        values = parameters(device) | {"tolerance": tolerance}
        return run_fmu(instance, values, PERIOD, case.fmu_periods, 10)

    return case.fmu_periods, run


def _heyoka(device: Device, bristle: Literal["path", "state"], periods: int) -> tuple[int, Run]:
    def run(tolerance: float) -> Outcome:
        held = HeldInputs(0.0, periods * PERIOD)
        end = simulate_sliding(device, held, tolerance=tolerance, bristle=bristle)
        return switching_outcome(end, device, held.stop)

    return periods, run


def _cvode(device: Device, periods: int) -> tuple[int, Run]:
    def run(tolerance: float) -> Outcome:
        held = HeldInputs(0.0, periods * PERIOD)
        end: SlidingEnd = simulate_lugre_cvode(device, held, tolerance=tolerance)
        return switching_outcome(end, device, held.stop)

    return periods, run


def _referee(device: Device, periods: int) -> Outcome:
    times = np.asarray(PERIOD * np.arange(periods + 1), dtype=np.float64)
    run = simulate_lugre(device, [HeldInputs(0.0, float(times[-1]))], times)
    return Outcome(times, run.position, run.velocity, run.reversals, run.steps, run.evaluations)
