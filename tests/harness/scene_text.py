"""Scenes of a test, from the text of a scene file."""

from __future__ import annotations

import tomllib

from slider_resonator.scenes.scene import Scene, scene_from


def scene_of(text: str) -> Scene:
    return scene_from(tomllib.loads(f'name = "mine"\ntitle = "Mine"\n{text}'), "mine.toml")


def table_1(needs: str, periods: float = 400.0, steps: float = 1.0) -> Scene:
    run = f"[run]\ndrive_periods = {periods}\nsteps_per_period = {steps}\n"
    return scene_of(f"{run}[need]\n{needs}\n")
