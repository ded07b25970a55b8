"""The files of scenes: built-in ones by name, others by their path."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import resources
from pathlib import Path

from slider_resonator.errors import SceneError, unknown_name


def built_in_scenes() -> dict[str, Path]:
    """Return the files of the built-in scenes by name, in alphabetical order."""
    folder = Path(str(resources.files("slider_resonator.scenes") / "built_in"))
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def find_scene(name_or_file: str) -> Path:
    """Return the file of a built-in scene or the file itself; SceneError names the nearest."""
    built_in = built_in_scenes()
    if name_or_file in built_in:
        return built_in[name_or_file]
    path = Path(name_or_file)
    if path.is_file():
        return path
    if path.is_dir():
        raise SceneError(f"{path}: is a directory; must be a scene file or a built-in scene")
    if path.suffix or len(path.parts) > 1:
        raise SceneError(
            f"{path}: no such scene file; `slider-resonator scenes` lists those built in"
        )
    unknown = unknown_name("scene", name_or_file, built_in)
    raise SceneError(f"{unknown}; `slider-resonator scenes` lists all")


def scene_files(scene: str) -> list[Path]:
    """Return a built-in scene's file, the file itself or those of a folder, in alphabetical order.

    Raises SceneError for a folder without any, and as `find_scene` does.
    """
    folder = Path(scene)
    if scene in built_in_scenes() or not folder.is_dir():
        return [find_scene(scene)]
    files = sorted(folder.glob("*.toml"))
    if not files:
        raise SceneError(
            f"{folder}: is a directory; must be a scene file, a built-in scene or a directory "
            "with scene files (*.toml)"
        )
    return files


def files_of_scenes(scenes: Sequence[str]) -> list[Path]:
    """Return the files of scenes, each as for `scene_files`; of all built-in ones without any."""
    if not scenes:
        return list(built_in_scenes().values())
    return [file for scene in scenes for file in scene_files(scene)]
