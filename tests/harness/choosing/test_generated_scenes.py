"""The choice for 200 scenes at random, each judged by whole runs.

All are judged each night, the first ones on each push.
"""

from __future__ import annotations

import time

import numpy as np
import pytest

from slider_resonator.choosing.choosing import choose_with
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.resolved import located_events
from tests.harness.choosing.generated_scenes import COUNT, generated_scene
from tests.harness.choosing.judging import Judge, Verdict, described, judge

FIRST, CHUNK = 10, 25
REFEREED = (46, 50)
"""Short scenes with Coulomb friction, whose inputs do not vary but by jumps."""


def verdicts(instance: Instance, seeds: range) -> list[Verdict]:
    """Choose and judge; print the shares that meet the needs and that are cheap, and the time."""
    found, longest = [], 0.0
    for seed in seeds:
        scene = generated_scene(seed)
        began = time.process_time()
        choice = choose_with(instance, scene)
        longest = max(longest, time.process_time() - began)
        found.append(judge(instance, scene, choice))
    print(
        f"scenes {seeds.start} to {seeds.stop - 1}: "
        f"{sum(v.met for v in found)} of {len(found)} meet their needs, "
        f"{sum(v.cheap for v in found)} within 1.5 of the cheapest, "
        f"the longest answer took {longest:.2f} s of CPU time"
    )
    return found


def judged(instance: Instance, seeds: range) -> None:
    found = verdicts(instance, seeds)
    lines = [
        described(verdict, f"scene {seed}") for verdict, seed in zip(found, seeds, strict=True)
    ]
    missed = [text for verdict, text in zip(found, lines, strict=True) if not verdict.met]
    expensive = [text for verdict, text in zip(found, lines, strict=True) if not verdict.cheap]
    assert not missed, "\n".join(["chosen, but does not meet the needs:", *missed])
    assert len(expensive) <= 0.1 * len(found), "\n".join(["more than 1.5 of cheapest:", *expensive])


def test_choices_for_the_first_scenes_meet_the_needs_at_little_cost(
    instance: Instance,
) -> None:
    judged(instance, range(FIRST))


@pytest.mark.parametrize(
    "seeds",
    [
        pytest.param(range(FIRST, CHUNK), marks=pytest.mark.slow),
        pytest.param(range(CHUNK, 2 * CHUNK), marks=pytest.mark.slow),
        *(
            pytest.param(range(first, first + CHUNK), marks=pytest.mark.nightly)
            for first in range(2 * CHUNK, COUNT, CHUNK)
        ),
    ],
)
def test_choices_meet_the_needs_at_little_cost(instance: Instance, seeds: range) -> None:
    judged(instance, seeds)


def test_some_scenes_suit_averaging_and_some_do_not() -> None:
    scenes = [generated_scene(seed) for seed in range(COUNT)]
    devices = [scene.device for scene in scenes]
    assert 0.3 < np.mean([device.friction_law for device in devices]) < 0.6
    assert min(device.damping_ratio for device in devices) < 0.002
    assert min(device.drive_frequency for device in devices) < 150.0
    assert any(device.normal_amplitude > device.normal_preload for device in devices)
    ratios = [scene.signals["frequency_ratio"].at(0.0) for scene in scenes]
    assert any(0.0 < abs(ratio - 1.0) < 0.01 for ratio in ratios)
    assert sum(not all(s.hold for s in scene.signals.values()) for scene in scenes) > 20
    needed = {name for scene in scenes if scene.need for name in scene.need.needs}
    assert len(needed) == 7, "every need is asked for"


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
    true = located_events.simulate(scene.device, schedule.held(), schedule.times)
    for name in ("position", "velocity"):
        reference = getattr(true, name)
        off = float(np.abs(record[name][at] - reference).max() / np.abs(reference).max())
        assert off < 1e-9, f"{name} is off by {off:.2g} of its peak"
