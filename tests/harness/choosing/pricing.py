"""Measured over modelled cost of hard scenes, by model: whether the prices of `cost` still hold.

`python -m tests.harness.choosing.pricing dist/SliderResonator.fmu` prints the quantiles: near
1 where they hold. CPU times of a busy machine scatter.
"""

from __future__ import annotations

import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import product
from math import ceil
from pathlib import Path

import numpy as np

from slider_resonator.choosing.candidate import Candidate
from slider_resonator.choosing.choosing import candidates
from slider_resonator.choosing.cost import search_cost
from slider_resonator.choosing.scales import scales_of
from slider_resonator.device.schedule import Schedule
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import Fmu, open_fmu
from slider_resonator.fmu.run import run
from slider_resonator.scenes.scene import Scene
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.steady_velocity import find_steady
from tests.harness.choosing.hard_scenes import KINDS, hard_scene

OUTPUTS = ("position", "velocity", "mean_velocity", "reversals")
REPEATS = 3
ENOUGH = 0.3
"""Seconds after which a measurement is not repeated."""
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


def cpu_time(task: Callable[[], object], repeats: int = REPEATS) -> float:
    """Return the shortest CPU time (s) of a task."""
    times: list[float] = []
    while len(times) < repeats and sum(times) < ENOUGH:
        began = time.process_time()
        task()
        times.append(time.process_time() - began)
    return min(times)


def run_time(fmu: Fmu, values: Mapping[str, float], schedule: Schedule) -> float:
    """Return the shortest CPU time (s) of a run, each in a new instance: one keeps its orbits."""
    times: list[float] = []
    while len(times) < REPEATS and sum(times) < ENOUGH:
        with instantiate(fmu) as instance:
            task = partial(run, instance, values, schedule, outputs=OUTPUTS)
            times.append(cpu_time(task, 1))
    return min(times)


def run_ratios(fmu: Fmu, instance: Instance, scene: Scene) -> Iterator[tuple[Candidate, float]]:
    """Yield measured over modelled cost of runs: each model, the extreme tolerances and steps."""
    priced = dict(candidates(instance, scene))
    has_slow_motion = scales_of(scene).has_slow_motion
    for model in {candidate.model for candidate in priced}:
        if model.averaging_order == 2 and not has_slow_motion:
            continue  # `choose` rules it out
        steps = sorted({c.step or 0.0 for c in priced if c.model == model})
        for tolerance in {model.tolerances[0], model.tolerances[-1]}:
            for step in {steps[0], steps[-1]}:
                candidate = Candidate(model, tolerance, step)
                values = {**scene.parameters, **candidate.parameters}
                schedule = scene.with_step(step).schedule()
                yield candidate, run_time(fmu, values, schedule) / priced[candidate]


def search_ratio(instance: Instance, scene: Scene, candidate: Candidate) -> float:
    """Return measured over modelled cost of finding the first steady need of a scene."""
    assert scene.need is not None
    name, scales = next(iter(scene.need.needs)), scales_of(scene)
    values = {**scene.values, **candidate.parameters}
    if candidate.model.fidelity == 0:

        def read() -> None:
            instance.start(values)
            instance.value(name)

        return cpu_time(read) / search_cost(candidate.model, candidate.tolerance, 0, scales)
    search = find_steady if name == "steady_velocity" else find_blocking
    periods = search(instance, values).periods
    modelled = search_cost(candidate.model, candidate.tolerance, periods, scales)
    return cpu_time(lambda: search(instance, values)) / modelled


def ratios(fmu: Fmu, seeds: Sequence[int]) -> dict[str, list[float]]:
    """Return measured over modelled costs by model and by what is done with it."""
    found: dict[str, list[float]] = defaultdict(list)
    with instantiate(fmu) as instance:
        for kind, seed in product(KINDS, seeds):
            _add_ratios(found, fmu, instance, kind, seed)
    return found


def _add_ratios(
    found: dict[str, list[float]], fmu: Fmu, instance: Instance, kind: str, seed: int
) -> None:
    scene = hard_scene(kind, seed)
    try:
        if scene.run is None:
            for candidate, _ in candidates(instance, scene):
                name = f"search, {candidate.model.name}"
                found[name].append(search_ratio(instance, scene, candidate))
        elif kind != "steady_beside_a_run":
            for candidate, ratio in run_ratios(fmu, instance, scene):
                found[f"run, {candidate.model.name}"].append(ratio)
    except FmuError as error:
        print(f"{scene.name}: {error}", file=sys.stderr)


def main(path: Path, count: int) -> None:
    """Print the quantiles of measured over modelled costs for `count` scenes of each kind."""
    with open_fmu(path) as fmu:
        found = ratios(fmu, range(count))
    width = ceil(max(map(len, found)))
    print(f"{'measured over modelled':{width}}", *(f"{q:>6.0%}" for q in QUANTILES), " count")
    for name, values in sorted(found.items()):
        shown = (f"{value:6.2f}" for value in np.quantile(values, QUANTILES))
        print(f"{name:{width}}", *shown, f"{len(values):6d}")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 4)
