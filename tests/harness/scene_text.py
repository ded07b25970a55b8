"""Scenes of a test, from the text of a scene file, and those built in."""

import tomllib
from functools import cache
from pathlib import Path

from slider_resonator.scenes.scene import Scene, read_scenes, scene_from
from slider_resonator.scenes.scene_files import find_scenes

HEAD = 'name = "mine"\ntitle = "Mine"\n'


def read_scene(path: Path) -> Scene:
    """Return the only scene of a file."""
    (scene,) = read_scenes(path)
    return scene


def scene_of(text: str, folder: Path = Path()) -> Scene:
    """Return the scene of a text below `HEAD`, whose CSV files are in `folder`."""
    return scene_from(tomllib.loads(HEAD + text), "mine.toml", folder)


@cache
def built_in() -> dict[str, Scene]:
    """Return the built-in scenes by name, read once: that takes a second."""
    return {scene.name: scene for scene in find_scenes([])}


def table_1(needs: str, periods: float = 400.0, steps: float = 1.0) -> Scene:
    run = f"[run]\ndrive_periods = {periods}\nsteps_per_period = {steps}\n"
    return scene_of(f"{run}[need]\n{needs}\n")
