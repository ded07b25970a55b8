"""What a drive period of Coulomb friction costs: FMUs, Taylor integration, DOP853, the paper's way.

The device is that of table 1 close to its steady motion, in which it reverses twice a period and
never sticks, so that heyoka can show what it is capable of at its fastest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import pi

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.resolved import located_events, taylor
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.studies.benchmark.cost import (
    REFEREE,
    Cost,
    Method,
    Outcome,
    Ratio,
    measure,
    ratio,
)
from slider_resonator.studies.benchmark.fmu_method import parameters, run_fmu
from slider_resonator.studies.benchmark.in_turn import Progress
from slider_resonator.studies.trade.peers import paper_method, switching_taylor

DEVICE = Device(
    initial_velocity=-0.0491,
    initial_resonator_displacement=-4.978e-4,
    initial_resonator_velocity=1.5837,
)
PERIOD = 2.0 * pi / DEVICE.drive_frequency
FMU_STEPS = 100
REFEREE_PERIODS = 200
LOCATED_PERIODS = 20
PAPER_PERIODS = 5
PAPER_TOLERANCES = (1e-6, 1e-8, 1e-10)
"""Absolute tolerances, in fractions of a typical velocity and displacement: the cost of stepping
over a jump hangs on them far more than on the relative tolerance."""
SWITCHING_TOLERANCE = 1e-9
"""The loosest tolerance at which heyoka's order is still low enough to be at its fastest; its error
is then below 1e-10."""
STEPS = (1, 10, 100)
"""Communication steps of an FMU in drive periods."""
COMPARED = 100
"""The step, in drive periods, whose cost the others are compared with."""


@dataclass(frozen=True)
class CoulombBenchmark:
    """All costs, and ratios of each peer to each FMU in steps of COMPARED drive periods."""

    repeats: int
    costs: tuple[Cost, ...]
    ratios: tuple[Ratio, ...]


def measure_coulomb(
    instances: Mapping[str, Instance], repeats: int, progress: Progress
) -> CoulombBenchmark:
    """Run everything `repeats` times and return medians; HarnessError without heyoka.

    `instances` are FMUs by the names to show.
    """
    try:
        referee = _reference(taylor.simulate, REFEREE_PERIODS)
    except ModuleNotFoundError as error:
        raise HarnessError(str(error)) from error
    methods = [*_fmu_methods(instances), *_peers()]
    costs = measure(methods, referee, DEVICE, repeats, progress)
    by_name = {cost.method: cost for cost in costs}
    ratios = [
        ratio(by_name[peer.name], by_name[fmu_name(name, COMPARED)])
        for name in instances
        for peer in _peers()
    ]
    return CoulombBenchmark(repeats, costs, tuple(ratios))


def fmu_name(name: str, step: int) -> str:
    """What an FMU in steps of `step` drive periods is called in the results."""
    return f"{name}, steps of {step} period{'s' if step > 1 else ''}"


def _fmu_methods(instances: Mapping[str, Instance]) -> Iterator[Method]:
    values = parameters(DEVICE)
    for name, instance in instances.items():
        for step in STEPS:
            periods = FMU_STEPS * step
            run = partial(run_fmu, instance, values, PERIOD, periods, step)
            yield Method(fmu_name(name, step), periods, run)


def _peers() -> Sequence[Method]:
    located: Sequence[tuple[str, int, Callable[..., Trajectory]]] = (
        (REFEREE, REFEREE_PERIODS, taylor.simulate),
        ("DOP853 with located events", LOCATED_PERIODS, located_events.simulate),
        *(
            (
                f"DOP853 on sgn, rtol 1e-6, atol {atol:.0e}",
                PAPER_PERIODS,
                partial(paper_method.simulate, atol=atol),
            )
            for atol in PAPER_TOLERANCES
        ),
    )
    return [
        Method("heyoka at its fastest", REFEREE_PERIODS, _switching),
        *(Method(name, n, partial(_reference, simulate, n)) for name, n, simulate in located),
    ]


def _switching() -> Outcome:
    held = HeldInputs(0.0, REFEREE_PERIODS * PERIOD)
    end = switching_taylor.simulate_sliding(DEVICE, held, tolerance=SWITCHING_TOLERANCE)
    return switching_outcome(end, DEVICE, held.stop)


def switching_outcome(end: switching_taylor.SlidingEnd, device: Device, stop: float) -> Outcome:
    """The outcome of a method that tells only where it ends, at `stop` (s)."""
    start = (device.initial_position, device.initial_velocity)
    position, velocity = np.array([start, end.state[:2]], dtype=np.float64).T
    times = np.array([0.0, stop])
    return Outcome(times, position, velocity, end.reversals, end.steps, end.evaluations or None)


def _reference(simulate: Callable[..., Trajectory], periods: int) -> Outcome:
    times = np.asarray(PERIOD * np.arange(periods + 1), dtype=np.float64)
    run = simulate(DEVICE, [HeldInputs(0.0, float(times[-1]))], times)
    return Outcome(times, run.position, run.velocity, run.reversals, run.steps, run.evaluations)
