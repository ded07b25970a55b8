"""Scenes by kind, at random within it: what choices for short, calm scenes never meet."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import pi
from typing import Any

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.references.closed_forms import equivalent_force
from slider_resonator.scenes.scene import Scene, scene_from
from tests.harness.choosing.generated_scenes import Draw, random_device
from tests.harness.choosing.hard_case import Case, constant, drive, lugre, strong

MAX_CHECKPOINTS = 3000
"""Communication points of a scene in its own step."""


def _some_input(case: Case) -> str:
    return "load" if case.draw.chance(0.5) else "phase"


def _late_jump(case: Case) -> None:
    strong(case)
    case.run(2e4, 3e5)
    count = int(case.draw.one_of(1, 1, 2, 3))
    case.jumps(_some_input(case), [case.draw.uniform(0.8, 0.999) for _ in range(count)], 1.0)
    case.need_some()


def _many_jumps(case: Case) -> None:
    strong(case)
    case.run(5e3, 2e5)
    count = int(case.draw.log(8.0, 80.0))
    case.jumps("phase", [case.draw.uniform(0.0, 1.0) for _ in range(count)], 1.0)
    if case.draw.chance(0.5):
        case.jumps("load", [case.draw.uniform(0.0, 1.0) for _ in range(count)], 0.3)
    case.need_some()


def _jump_near_the_end(case: Case) -> None:
    strong(case)
    case.run(4e3, 2e5)
    before = case.draw.log(3.0, 600.0) / case.periods
    case.jumps(_some_input(case), [1.0 - before], 1.5)
    case.need_some()


def _early_jump(case: Case) -> None:
    strong(case)
    case.run(4e3, 2e5)
    case.jumps(_some_input(case), [case.draw.log(10.0, 3000.0) / case.periods], 1.0)
    case.need_some()


def _jump_between_windows(case: Case) -> None:
    """Jump far from the end, and read there what is left of it."""
    strong(case)
    case.run(1e4, 1e5)
    case.jumps("phase", [case.draw.uniform(0.2, 0.9) for _ in range(2)], 3.0)
    case.need("position", loosest=0.03)


def _short_jump(case: Case) -> None:
    case.run(30.0, 2500.0)
    case.jumps(_some_input(case), [case.draw.uniform(0.05, 0.95) for _ in range(2)], 1.0)
    case.need_some()


def _long_ramp(case: Case) -> None:
    strong(case)
    case.run(5e3, 1e5)
    case.inputs["load"] = {"ramp": [(0.0, 0.0), (case.duration, 0.4 * case.friction)]}
    case.need_some(tightest=1e-3)


def _polyline(case: Case) -> None:
    strong(case)
    case.run(1e3, 3e4)
    count = int(case.draw.log(5.0, 60.0))
    times = np.linspace(0.0, case.duration, count + 1).tolist()
    walk = [0.5 * case.friction * case.draw.uniform(-1.0, 1.0) for _ in times]
    case.inputs["load"] = {"ramp": list(zip(times, walk, strict=True))}
    case.need_some(tightest=1e-3)


def _ratio_jump(case: Case) -> None:
    case.run(100.0, 2e4)
    ratios = [case.draw.one_of(1.0, 2.0, 3.0, 0.5, 1.5) for _ in range(3)]
    times = [0.0, case.draw.uniform(0.1, 0.5), case.draw.uniform(0.5, 0.95)]
    points = list(zip([t * case.duration for t in times], ratios, strict=True))
    case.inputs["frequency_ratio"] = {"steps": points}
    case.need_some()


def _slow_ratio_ramp(case: Case) -> None:
    strong(case)
    case.run(300.0, 5e3)
    end = 1.0 + case.draw.uniform(-0.05, 0.05)
    case.inputs["frequency_ratio"] = {"ramp": [(0.0, 1.0), (case.duration, end)]}
    case.need_some(tightest=1e-3)


def _long_beat(case: Case) -> None:
    strong(case)
    case.run(1e4, 2e5)
    beats = case.draw.log(0.1, 300.0)
    case.inputs["frequency_ratio"] = 1.0 + case.draw.one_of(-1.0, 1.0) * beats / case.periods
    if beats > 5.0 and case.draw.chance(0.5):
        case.need("beat", loosest=0.05, tightest=1e-5)
    else:
        case.need_some()


def _short_beat(case: Case) -> None:
    case.run(500.0, 3e3)
    beats = case.draw.log(5.0, 50.0)
    case.inputs["frequency_ratio"] = 1.0 + min(beats / case.periods, 0.08)
    case.need("beat", loosest=0.05, tightest=1e-5)


def _flight_at_the_start(case: Case) -> None:
    case.device["normal_amplitude"] = case.device["normal_preload"] * case.draw.uniform(1.1, 2.5)
    case.run(100.0, 5e4)
    case.inputs["phase"] = -0.5 * pi
    case.inputs["frequency_ratio"] = case.draw.one_of(1.0, 1.0, 0.01, 0.2, 2.0)
    case.need_some()


def _sticking(case: Case) -> None:
    drive(case, case.draw.log(0.2, 3.0))
    case.run(30.0, 2e4)
    case.need_some()


def _free_stiff_bristle(case: Case) -> None:
    lugre(case, case.draw.log(1e3, 1e9))
    case.run(30.0, 2e4)
    case.need_some(tightest=1e-6)
    case.needs["friction_law"] = "free"


def _soft_bristle(case: Case) -> None:
    lugre(case, case.draw.log(1e-3, 1.0))
    case.run(30.0, 2e4)
    case.need_some(tightest=1e-5)


def _bristle_with_a_long_memory(case: Case) -> None:
    """Soft bristles that remember for longer than windows last, some in flight."""
    strong(case)
    lugre(case, case.draw.log(3e-4, 1e-2))
    if case.draw.chance(0.5):
        preload = case.device["normal_preload"]
        case.device["normal_amplitude"] = preload * case.draw.uniform(1.1, 2.0)
    case.run(3e3, 2e5)
    case.need_some()


def _steady(case: Case) -> None:
    constant(case)
    name = "steady_velocity" if case.draw.chance(0.5) else "blocking_force"
    case.need(name, loosest=0.1, tightest=1e-7)


def _steady_lugre(case: Case) -> None:
    lugre(case, case.draw.log(1e-2, 1e5))
    _steady(case)
    if case.draw.chance(0.5):
        case.needs["friction_law"] = "free"


def _steady_coarse(case: Case) -> None:
    strong(case)
    if case.draw.chance(0.6):
        lugre(case, case.draw.log(1e-2, 1e5))
    constant(case)
    case.need("steady_velocity", "blocking_force", loosest=0.3, tightest=0.01)


def _steady_in_flight(case: Case) -> None:
    if case.draw.chance(0.6):
        lugre(case, case.draw.log(1e-2, 1e5))
    case.device["normal_amplitude"] = case.device["normal_preload"] * case.draw.uniform(1.1, 2.5)
    _steady(case)


def _steady_beside_a_run(case: Case) -> None:
    constant(case)
    case.run(30.0, 2e4)
    case.need("steady_velocity", "mean_velocity", loosest=0.1, tightest=1e-5)


def _start_elsewhere(case: Case) -> None:
    fast = equivalent_force(Device.from_mapping(case.device)).velocity_amplitude
    case.device["initial_velocity"] = fast * case.draw.uniform(-1.5, 1.5)
    case.device["initial_position"] = case.draw.uniform(-1.0, 1.0)
    if case.draw.chance(0.5):
        swing = fast * case.draw.uniform(-3.0, 3.0)
        case.device["initial_resonator_velocity"] = swing
    case.run(100.0, 3e4)
    case.need_some()


def _long_memory(case: Case) -> None:
    case.device["damping_ratio"] = case.draw.log(1e-5, 2e-3)
    case.run(300.0, 1e5)
    if case.draw.chance(0.5):
        case.jumps("load", [case.draw.uniform(0.1, 0.9)], 0.5)
    case.need_some()


def _few_periods(case: Case) -> None:
    case.run(0.5, 15.0)
    case.need_some(tightest=1e-8)


def _events(case: Case) -> None:
    case.run(10.0, 300.0)
    if case.draw.chance(0.5):
        case.jumps(_some_input(case), [case.draw.uniform(0.1, 0.9)], 0.5)
    case.need("event_times", loosest=0.01, tightest=1e-8)


def _direct_drive(case: Case) -> None:
    case.device["tangential_force"] = case.draw.log(30.0, 1e3) * case.friction
    case.device["base_amplitude"] = 0.0
    case.run(1e3, 1e5)
    if case.draw.chance(0.7):
        case.jumps("phase", [case.draw.uniform(0.3, 0.98)], 1.0)
    case.need_some()


def _load_that_overcomes_friction(case: Case) -> None:
    strong(case)
    case.run(3e3, 1e5)
    at = case.draw.uniform(0.3, 0.95) * case.duration
    case.inputs["load"] = {"steps": [(0.0, 0.0), (at, 1.5 * case.friction)]}
    case.need_some()


def _lines_passed_on(case: Case) -> None:
    strong(case)
    case.run(300.0, 3e4)
    for name, size in (("load", 0.4 * case.friction), ("phase", 1.0)):
        count = int(case.draw.log(1.0, 30.0))
        times = np.linspace(0.0, case.duration, count + 1).tolist()
        walk = [size * case.draw.uniform(-1.0, 1.0) for _ in times]
        case.inputs[name] = {"ramp": list(zip(times, walk, strict=True))}
    case.interpolates = True
    case.need_some(tightest=1e-8)


def _tuned(case: Case) -> None:
    strong(case)
    case.run(300.0, 1e4)
    for name in ("friction_coefficient", "normal_amplitude"):
        first = case.device.pop(name)
        values = [first, first * case.draw.uniform(0.7, 1.3)]
        kind = "ramp" if case.draw.chance(0.3) else "steps"
        at = case.draw.uniform(0.2, 0.9) * case.duration
        case.tuning[name] = {kind: list(zip((0.0, at), values, strict=True))}
    case.need_some(tightest=1e-3)


KINDS: Mapping[str, Callable[[Case], None]] = {
    "late_jump": _late_jump,
    "many_jumps": _many_jumps,
    "jump_near_the_end": _jump_near_the_end,
    "early_jump": _early_jump,
    "jump_between_windows": _jump_between_windows,
    "short_jump": _short_jump,
    "long_ramp": _long_ramp,
    "polyline": _polyline,
    "ratio_jump": _ratio_jump,
    "slow_ratio_ramp": _slow_ratio_ramp,
    "long_beat": _long_beat,
    "short_beat": _short_beat,
    "flight_at_the_start": _flight_at_the_start,
    "sticking": _sticking,
    "free_stiff_bristle": _free_stiff_bristle,
    "soft_bristle": _soft_bristle,
    "steady": _steady,
    "steady_lugre": _steady_lugre,
    "steady_coarse": _steady_coarse,
    "steady_in_flight": _steady_in_flight,
    "steady_beside_a_run": _steady_beside_a_run,
    "start_elsewhere": _start_elsewhere,
    "long_memory": _long_memory,
    "few_periods": _few_periods,
    "events": _events,
    "direct_drive": _direct_drive,
    "load_that_overcomes_friction": _load_that_overcomes_friction,
    "lines_passed_on": _lines_passed_on,
    "tuned": _tuned,
    "bristle_with_a_long_memory": _bristle_with_a_long_memory,
}


def hard_scene(kind: str, seed: int) -> Scene:
    """Return the scene of a kind and a seed."""
    draw = Draw(np.random.default_rng([20261122, list(KINDS).index(kind), seed]))
    case = Case(draw, random_device(draw))
    KINDS[kind](case)
    name = f"{kind}_{seed}"
    content: dict[str, Any] = {
        "name": name,
        "title": name,
        "device": case.device,
        "inputs": case.inputs,
        "tuning": case.tuning,
        "need": case.needs,
    }
    if case.periods:
        per_period = min(draw.one_of(1.0, 4.0, 16.0), MAX_CHECKPOINTS / case.periods)
        content["run"] = {
            "stop_time": case.duration,
            "steps_per_period": per_period,
            "interpolate": case.interpolates,
        }
    return scene_from(content, name)
