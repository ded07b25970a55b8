"""Scenes: what is run and what must come out, read from TOML files."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from math import pi
from pathlib import Path

from pydantic import ValidationError

from harness.csv_signal import csv_points
from harness.errors import SceneError
from harness.interface import INPUTS
from harness.names import unknown_name
from harness.references.device import Device
from harness.scene_errors import explanations
from harness.scene_model import ExpectTable, InputTable, NeedTable, SceneTable, SweepTable
from harness.schedule import Schedule, Signal, constant, ramp, schedule, step_count, steps


@dataclass(frozen=True)
class Scene:
    """A scene that has been read and found sound.

    `parameters` are the device parameters that differ from their start, `signals` the inputs by
    name. `stop_time` and `step_size` (s) are None for a scene without a run. `files` are all that
    it was read from.
    """

    name: str
    title: str
    description: str
    source: str
    parameters: Mapping[str, float]
    signals: Mapping[str, Signal]
    stop_time: float | None
    step_size: float | None
    expect: tuple[ExpectTable, ...]
    sweep: SweepTable | None
    need: NeedTable | None
    files: tuple[Path, ...]

    @property
    def device(self) -> Device:
        """The device with all its parameters."""
        return Device.from_mapping(self.parameters)

    @property
    def values(self) -> dict[str, float]:
        """Parameters, and inputs as they are at the start."""
        return {**self.parameters, **{name: s.at(0.0) for name, s in self.signals.items()}}

    def schedule(self) -> Schedule:
        """Return inputs and communication points; SceneError for a scene without a run."""
        if self.stop_time is None or self.step_size is None:
            raise SceneError(
                f"{self.source}: scene {self.name} has no [run] and cannot be run; the command "
                "scenes shows which can"
            )
        return schedule(self.stop_time, self.step_size, **self.signals)


def read_scene(path: Path, overrides: Mapping[str, float] | None = None) -> Scene:
    """Read a scene file; `overrides` replace parameters, or inputs by a constant.

    Values that `check_value` refuses must not be among them.
    Raises SceneError with file, key, value and what is allowed.
    """
    source = str(path)
    try:
        with path.open("rb") as file:
            content = tomllib.load(file)
    except OSError as error:
        raise SceneError(f"{source}: cannot be read: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SceneError(f"{source}: not TOML: {error}") from error
    try:
        table = SceneTable.model_validate(content)
    except ValidationError as error:
        raise SceneError("\n".join(explanations(source, error))) from error
    return _scene(table, path, overrides or {})


def built_in_scenes() -> dict[str, Path]:
    """Return the files of the built-in scenes by name, in alphabetical order."""
    folder = Path(str(resources.files("harness") / "scenes"))
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
    if path.suffix == ".toml":
        raise SceneError(f"{path}: no such scene file")
    raise SceneError(unknown_name("scene", name_or_file, built_in))


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
    return [file for scene in scenes or built_in_scenes() for file in scene_files(scene)]


def sweep_points(scene: Scene, path: Path) -> Iterator[tuple[Mapping[str, float], Scene]]:
    """Yield what is varied and the scene with it, once with nothing varied without a sweep."""
    if scene.sweep is None:
        yield {}, scene
        return
    for value in scene.sweep.values:
        varied = {scene.sweep.variable: value}
        yield varied, read_scene(path, varied)


def _scene(table: SceneTable, path: Path, overrides: Mapping[str, float]) -> Scene:
    parameters = {**table.device, **{k: v for k, v in overrides.items() if k not in INPUTS}}
    device = Device.from_mapping(parameters)
    signals = {}
    for name in INPUTS:
        given = constant(overrides[name]) if name in overrides else None
        signals[name] = given or _signal(getattr(table.inputs, name), name, path)
    period = 2.0 * pi / device.drive_frequency
    run = table.run
    stop_time = step_size = None
    if run is not None:
        stop_time = run.stop_time or (run.drive_periods or 0.0) * period
        step_size = run.step_size or period / (run.steps_per_period or 1.0)
        try:
            step_count(stop_time, step_size)
        except ValueError as error:
            raise SceneError(f"{path}: run: {error}") from error
    tables = [getattr(table.inputs, name) for name in INPUTS]
    return Scene(
        name=table.name,
        title=table.title,
        description=table.description.strip(),
        source=str(path),
        parameters=parameters,
        signals=signals,
        stop_time=stop_time,
        step_size=step_size,
        expect=table.expect,
        sweep=table.sweep,
        need=table.need,
        files=(path, *(path.parent / read.csv for read in tables if read.csv is not None)),
    )


def _signal(table: InputTable, name: str, path: Path) -> Signal:
    try:
        if table.steps is not None:
            return steps(table.steps)
        if table.ramp is not None:
            return ramp(table.ramp)
        if table.csv is not None:
            points = csv_points(path.parent / table.csv, table.column or name)
            return steps(points) if table.between == "hold" else ramp(points)
        return constant(table.constant or 0.0)
    except ValueError as error:
        raise SceneError(f"{path}: inputs.{name}: {error}") from error
