"""States of any content with a valid seal: what is restored is stepped, read and stored again."""

from __future__ import annotations

import hashlib
import json
import math
import time
from random import Random
from typing import Any

import pytest

from fmu_src.python.slider_component.component import Component
from fmu_src.python.slider_component.snapshot import from_bytes, to_bytes
from fmu_src.python.slider_component.values import Refusal
from fmu_src.python.slider_component.variables import VARIABLES

OUTPUTS = [variable.name for variable in VARIABLES if variable.causality == "output"]
RATIOS = (1.0, 2.0, -1.0, 0.0, 0.5, 1.01, 0.003, 1.37)
POWERS = (1e-300, 1e-20, 1e-6, 0.5, 1.0 + 1e-15, 2.0, 1e3, 1e12, 1e200)
SPECIAL = (0.0, -0.0, 1.0, -1.0, 5e-324, 1e-300, 1e300, -1e300, 1.7e308, 10**400, 7, None, "x")
ODD: tuple[Any, ...] = ([], {}, True, math.nan, math.inf, [[[]]], {"a": {"b": 1}})
STEPS = 2
MAX_SECONDS = 60.0
"""Longest call: the native build is some hundred times faster."""


def moved_component(random: Random) -> Component:
    component = Component()
    component.set(
        {
            "friction_law": random.randrange(2),
            "fidelity": random.randrange(3),
            "averaging_order": random.choice((1, 2)),
            "friction_faces": random.choice((1, 2)),
            "frequency_ratio": random.choice(RATIOS),
            "normal_amplitude": random.choice((1.0, 0.0, 0.7, 3.0)),
        }
    )
    component.enter_initialization()
    component.exit_initialization()
    for _ in range(random.randrange(3)):
        component.step(component.time, 1e-3 * random.random() + 1e-6)
    return component


def leaves(plain: Any, path: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    if not isinstance(plain, dict):
        return [path]
    return [leaf for key, value in plain.items() for leaf in leaves(value, (*path, key))]


def odd_value(random: Random, before: object) -> object:
    if random.random() < 0.02:
        return random.choice(ODD)
    if isinstance(before, bool) or not isinstance(before, int | float):
        return random.choice(SPECIAL) if random.random() < 0.5 else before
    if random.random() < 0.3 and abs(before) < 1e300:
        return before * random.choice(POWERS)
    if random.random() < 0.2:
        return -before
    if isinstance(before, int) and random.random() < 0.7:
        return random.randrange(-1, 4)
    return random.choice(SPECIAL) if random.random() < 0.4 else random.uniform(-10.0, 10.0)


def changed_state(random: Random, component: Component) -> bytes:
    """A state of some device in motion with a few entries replaced, sealed anew."""
    _, _, body = to_bytes(component.snapshot()).partition(b"\n")
    plain = json.loads(body)
    for _ in range(1 + random.randrange(4)):
        *path, last = random.choice(leaves(plain))
        part = plain
        for key in path:
            part = part[key]
        part[last] = odd_value(random, part[last])
    body = json.dumps(plain, sort_keys=True).encode()
    return hashlib.sha256(body).hexdigest().encode() + b"\n" + body


def step_size(random: Random, component: Component) -> float:
    """Some turns of the fastest frequency, so that work does not grow with it."""
    drive, ratio, mass, part, own = component.get(
        *("drive_frequency", "frequency_ratio", "slider_mass", "resonator_mass"),
        "resonator_frequency",
    )
    free = math.sqrt(1.0 + part / mass) * own
    return 5.0 * random.random() ** 2 / max(drive, abs(drive * ratio), free)


def read_all(component: Component) -> int:
    count = 0
    for name in OUTPUTS:
        try:
            (value,) = component.get(name)
        except Refusal:
            continue
        assert math.isfinite(value), name
        count += 1
    return count


def try_state(random: Random) -> tuple[int, int]:
    """Return how many steps and readings an accepted state stood; what else is raised escapes."""
    component = moved_component(random)
    try:
        component.restore(from_bytes(changed_state(random, component)))
    except Refusal:
        return 0, 0
    steps, count = 0, read_all(component)
    for _ in range(STEPS):
        size = step_size(random, component)
        before = component.snapshot()
        try:
            component.step(component.time, size)
        except Refusal:
            assert component.snapshot() == before
        else:
            steps += 1
        count += read_all(component)
    from_bytes(to_bytes(component.snapshot()))
    return steps, count


def attack(seed: int, cases: int) -> tuple[int, int, float]:
    """Return how many steps and readings were carried out, and the longest case in s."""
    steps = count = 0
    longest = 0.0
    for number in range(cases):
        began = time.process_time()
        try:
            stood = try_state(Random(f"{seed} {number}"))
        except Exception as error:
            raise AssertionError(f"seed {seed}, case {number}: {error!r}") from error
        longest = max(longest, time.process_time() - began)
        assert longest < MAX_SECONDS, f"seed {seed}, case {number}: {longest} s"
        steps, count = steps + stood[0], count + stood[1]
    return steps, count, longest


@pytest.mark.slow
def test_no_sealed_state_does_harm() -> None:
    steps, count, _ = attack(1, 150)
    assert steps > 50
    assert count > 1000
