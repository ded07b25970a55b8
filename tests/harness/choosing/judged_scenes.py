"""Choices for hard scenes: how many meet their needs, how many cost at most 1.5 of the cheapest.

`python -m tests.harness.choosing.judged_scenes dist/SliderResonator.fmu 10` judges ten scenes
of each kind.
"""

from __future__ import annotations

import sys
from pathlib import Path

from slider_resonator.choosing.choosing import choose_with
from slider_resonator.fmu.instance import instantiate
from slider_resonator.fmu.opening import open_fmu
from tests.harness.choosing.hard_scenes import KINDS, hard_scene
from tests.harness.choosing.judging import described, judge


def main(path: Path, count: int) -> None:
    """Print the shares for each kind, and the misses."""
    totals = [0, 0]
    with open_fmu(path) as fmu, instantiate(fmu) as instance:
        for kind in KINDS:
            found = [0, 0]
            for seed in range(count):
                scene = hard_scene(kind, seed)
                verdict = judge(instance, scene, choose_with(instance, scene))
                found = [found[0] + verdict.met, found[1] + verdict.cheap]
                if not (verdict.met and verdict.cheap):
                    print(described(verdict, scene.name))
            totals = [total + one for total, one in zip(totals, found, strict=True)]
            print(f"{kind}: {found[0]} of {count} met, {found[1]} cheapest", flush=True)
    number = count * len(KINDS)
    print(f"all: needs met in {totals[0]} of {number}, cheapest in {totals[1]} of {number}")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 10)
