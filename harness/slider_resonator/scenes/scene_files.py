"""Find scenes: built-in ones by name, others by their file, as `FILE#NAME` where it has several."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from importlib import resources
from pathlib import Path

from slider_resonator.errors import SceneError, unknown_name
from slider_resonator.scenes.device_file import DeviceFile
from slider_resonator.scenes.scene import Scene, only_scene, read_scenes

_NAME = re.compile(r'^name = "([^"]+)"', re.MULTILINE)

FIRST = "table_1"
"""The scene that is listed first."""


def built_in_scenes() -> dict[str, Path]:
    """Return the files of the built-in scenes by name: table 1, the core, then the thorough ones.

    A file may have several.
    """
    scenes: dict[str, Path] = {}
    for folder in ("core", "thorough"):
        place = Path(str(resources.files("slider_resonator.scenes") / "built_in" / folder))
        texts = {path: path.read_text("utf-8") for path in place.glob("*.toml")}
        scenes |= sorted((name, path) for path in texts for name in _NAME.findall(texts[path]))
    return {FIRST: scenes[FIRST], **scenes}


def is_core(scene: Scene) -> bool:
    """Whether a scene is one of the core."""
    return scene.files[0].parent.name == "core"


def find_scene(
    name_or_file: str, values: Mapping[str, float] | None = None, device: DeviceFile | None = None
) -> Scene:
    """Return the built-in scene of a name, or that of a file, as `FILE#NAME` one of several.

    `device` takes the place of the scene's as in `Scene.with_device`, `values` replace those of
    both, and the title says so. Raises SceneError with the nearest name, and as `read_scenes` does.
    """
    scene = only_scene(_scenes_of(name_or_file), name_or_file)
    if not values and not (device and device.values):
        return scene
    varied = scene.with_device(device.values if device else {}).with_values(values or {})
    title = f"{device.title}, in scene {scene.name}" if device else scene.title
    return replace(varied, title=f"{title}, {', '.join(values)} replaced" if values else title)


def find_scenes(names_or_files: Sequence[str]) -> list[Scene]:
    """Return scenes by name, file or folder, each once; all built-in ones for an empty sequence.

    Raises SceneError for a folder without scene files, and as `find_scene` does.
    """
    if not names_or_files:
        files = dict.fromkeys(built_in_scenes().values())
        read = {scene.name: scene for file in files for scene in read_scenes(file)}
        return [read[name] for name in built_in_scenes()]
    given = dict.fromkeys(names_or_files)
    return [scene for one in given for scene in _scenes_of(one, folders=True)]


def _scenes_of(name_or_file: str, *, folders: bool = False) -> Sequence[Scene]:
    """Return a built-in scene, or those of a file or, where they may be given, of a folder."""
    built_in, path = built_in_scenes(), Path(name_or_file)
    if name_or_file in built_in:
        return read_scenes(built_in[name_or_file], name_or_file)
    if path.is_dir():
        files = sorted(path.glob("*.toml")) if folders else []
        if files:
            return [scene for file in files for scene in read_scenes(file)]
        also = " or a directory with scene files (*.toml)" if folders else ""
        raise SceneError(f"{path}: is a directory; must be a scene file, a built-in scene{also}")
    file, _, name = name_or_file.partition("#")
    if Path(file).is_file():
        return read_scenes(Path(file), name or None)
    if path.suffix or len(path.parts) > 1:
        raise SceneError(
            f"{path}: no such scene file; `slider-resonator scenes` lists those built in"
        )
    unknown = unknown_name("scene", name_or_file, built_in)
    raise SceneError(f"{unknown}; `slider-resonator scenes --all` lists all")


def template() -> str:
    """Return a commented scene to start from."""
    return (resources.files(__package__) / "template.toml").read_text(encoding="utf-8")
