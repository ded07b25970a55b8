"""Choices judged by full runs of all candidates: scenes of a table, and random ones."""

from __future__ import annotations

import textwrap
import time
from itertools import chain
from math import inf

import numpy as np
import pytest

from slider_resonator.choosing.choosing import choose_with
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.scenes.scene import Scene
from tests.harness.choosing.generated_scenes import COUNT, generated_scene
from tests.harness.choosing.judging import Judge, judge
from tests.harness.choosing.scene_table import SCENES
from tests.harness.scene_text import scene_of

OFTEN = ("late_jump", "polyline_that_is_held", "flight", "stiff_bristle", "steady_beside_a_run")
"""Scenes that are judged on each push."""
WITHIN = 1.5
"""Largest cost of a choice over the lowest: CPU times of a busy machine scatter by that."""
JUDGINGS = 3
"""Times that costs are measured before a choice counts as expensive."""
FIRST, CHUNK = 4, 25
REFEREED = (46, 50)
"""Short scenes with Coulomb friction, whose inputs do not vary but by jumps."""


def judged(instance: Instance, scenes: dict[str, Scene]) -> None:
    """Choose and judge; print the shares that meet the needs and that are cheap, and the time."""
    missed, expensive, ratios, times = [], [], [], []
    for name, scene in scenes.items():
        began = time.process_time()
        choice = choose_with(instance, scene)
        times.append(time.process_time() - began)
        verdict = judge(instance, scene, choice)
        if not verdict.met:
            missed.append(verdict.described(name))
        if choice.meets:
            again = (judge(instance, scene, choice) for _ in range(JUDGINGS - 1))
            costs = (one.cost / one.lowest for one in chain([verdict], again))
            ratios.append(next((cost for cost in costs if cost <= WITHIN), inf))
            if ratios[-1] > WITHIN:
                expensive.append(verdict.described(name))
    print(
        f"{len(scenes)} scenes: {len(scenes) - len(missed)} meet their needs, "
        f"cost over lowest {sorted(round(ratio, 2) for ratio in ratios)}, "
        f"CPU time of an answer {np.median(times):.2f} s, at most {max(times):.2f} s"
    )
    assert not missed, "\n".join(["chosen, but does not meet the needs:", *missed])
    assert len(expensive) <= 0.1 * len(scenes), "\n".join(["not the cheapest:", *expensive])


@pytest.mark.parametrize(
    "name",
    [name if name in OFTEN else pytest.param(name, marks=pytest.mark.slow) for name in SCENES],
)
def test_a_choice_for_a_hard_scene_meets_its_needs_at_little_cost(
    instance: Instance, name: str
) -> None:
    judged(instance, {name: scene_of(textwrap.dedent(SCENES[name]))})


@pytest.mark.parametrize(
    "seeds",
    [
        range(FIRST),
        *(
            pytest.param(range(first, first + CHUNK), marks=pytest.mark.nightly)
            for first in range(0, COUNT, CHUNK)
        ),
    ],
)
def test_choices_for_random_scenes_meet_their_needs_at_little_cost(
    instance: Instance, seeds: range
) -> None:
    judged(instance, {f"scene_{seed}": generated_scene(seed) for seed in seeds})


@pytest.mark.slow
@pytest.mark.parametrize("seed", REFEREED)
def test_the_judge_agrees_with_an_independent_reference(instance: Instance, seed: int) -> None:
    scene = generated_scene(seed)
    assert scene.step_size is not None
    assert scene.device.friction_law == 0
    assert all(signal.hold for signal in scene.signals.values())
    record = Judge(instance, scene).reference_record(scene.step_size)
    schedule = scene.schedule()
    at = np.searchsorted(record.times, schedule.times)
    true = simulate(scene.device, schedule.held(), schedule.times)
    for name in ("position", "velocity"):
        reference = getattr(true, name)
        off = float(np.abs(record[name][at] - reference).max() / np.abs(reference).max())
        assert off < 1e-9, f"{name} is off by {off:.2g} of its peak"
