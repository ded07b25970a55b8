"""Scenes written down in a test."""

from __future__ import annotations

from pathlib import Path

from slider_resonator.scenes.scene import Scene, read_scene


def scene_of(folder: Path, text: str) -> Scene:
    path = folder / "mine.toml"
    path.write_text(f'name = "mine"\ntitle = "Mine"\n{text}')
    return read_scene(path)


def table_1(folder: Path, needs: str, periods: float = 400.0, steps: float = 1.0) -> Scene:
    run = f"[run]\ndrive_periods = {periods}\nsteps_per_period = {steps}\n"
    return scene_of(folder, f"{run}[need]\n{needs}\n")
