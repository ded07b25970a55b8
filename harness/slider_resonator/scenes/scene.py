"""Scenes as data: what is run and what is expected; read from TOML files."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import resources
from math import pi
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUTS
from slider_resonator.device.schedule import (
    Schedule,
    Signal,
    constant,
    ramp,
    schedule,
    step_count,
    steps,
)
from slider_resonator.errors import SceneError, unknown_name
from slider_resonator.scenes.csv_signal import csv_points
from slider_resonator.scenes.explanations import explanations
from slider_resonator.scenes.schema import (
    ExpectTable,
    InputTable,
    NeedTable,
    RunTable,
    SceneTable,
    SweepTable,
)


@dataclass(frozen=True)
class Scene:
    """A valid scene; it can be pickled. Raises SceneError for a run of too many steps.

    `parameters` are the device parameters that differ from their start, `signals` the inputs by
    name. `source` names the scene in messages; `files` are all that it was read from.
    """

    name: str
    title: str
    description: str
    source: str
    parameters: Mapping[str, float]
    signals: Mapping[str, Signal]
    run: RunTable | None
    expect: tuple[ExpectTable, ...]
    sweep: SweepTable | None
    need: NeedTable | None
    files: tuple[Path, ...]

    def __post_init__(self) -> None:
        if self.stop_time is None or self.step_size is None:
            return
        try:
            step_count(self.stop_time, self.step_size)
        except ValueError as error:
            raise SceneError(f"{self.source}: run: {error}") from error

    @property
    def device(self) -> Device:
        """The device with all its parameters."""
        return Device.from_mapping(self.parameters)

    @property
    def drive_period(self) -> float:
        """Drive period in seconds."""
        return 2.0 * pi / self.device.drive_frequency

    @property
    def stop_time(self) -> float | None:
        """Length of the run in seconds, None for a scene without a run."""
        if self.run is None:
            return None
        return self.run.stop_time or (self.run.drive_periods or 0.0) * self.drive_period

    @property
    def step_size(self) -> float | None:
        """Communication step in seconds, None for a scene without a run."""
        if self.run is None:
            return None
        return self.run.step_size or self.drive_period / (self.run.steps_per_period or 1.0)

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

    def with_values(self, values: Mapping[str, float]) -> Scene:
        """Return the scene with parameters replaced, and inputs by a constant.

        The values must be ones that `check_value` accepts.
        """
        inputs = {name: constant(value) for name, value in values.items() if name in INPUTS}
        parameters = {name: value for name, value in values.items() if name not in INPUTS}
        return replace(
            self,
            parameters={**self.parameters, **parameters},
            signals={**self.signals, **inputs},
        )

    def with_step(self, step_size: float) -> Scene:
        """Return the scene, which must have a run, with communication steps of a size in s."""
        assert self.run is not None
        step = {"step_size": step_size, "steps_per_period": None}
        return replace(self, run=self.run.model_copy(update=step))

    def points(self) -> tuple[ScenePoint, ...]:
        """Return the points of the sweep, or without a sweep the scene as its only point."""
        if self.sweep is None:
            return (ScenePoint(self),)
        swept = ({self.sweep.variable: value} for value in self.sweep.values)
        return tuple(ScenePoint(self.with_values(at), at) for at in swept)


@dataclass(frozen=True, eq=False)
class ScenePoint:
    """A scene at a point of its sweep: `at` are the varied values, empty without a sweep.

    Points are equal only to themselves, and can be keys.
    """

    scene: Scene
    at: Mapping[str, float] = field(default_factory=dict)


def read_scene(path: Path, values: Mapping[str, float] | None = None) -> Scene:
    """Read a scene file; `values` replace those in it as in `Scene.with_values`.

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
    scene = scene_from(content, source, path.parent)
    return replace(scene, files=(path, *scene.files)).with_values(values or {})


def scene_from(content: Mapping[str, Any], source: str, folder: Path = Path()) -> Scene:
    """Return the scene of parsed TOML, or data of the same form, whose CSV files are in `folder`.

    Raises SceneError with `source`, key, value and what is allowed.
    """
    try:
        table = SceneTable.model_validate(content)
    except ValidationError as error:
        raise SceneError("\n".join(explanations(source, error))) from error
    inputs = {name: getattr(table.inputs, name) for name in INPUTS}
    return Scene(
        name=table.name,
        title=table.title,
        description=table.description.strip(),
        source=source,
        parameters=table.device,
        signals={name: _signal(given, name, source, folder) for name, given in inputs.items()},
        run=table.run,
        expect=table.expect,
        sweep=table.sweep,
        need=table.need,
        files=tuple(folder / given.csv for given in inputs.values() if given.csv is not None),
    )


def _signal(table: InputTable, name: str, source: str, folder: Path) -> Signal:
    try:
        if table.steps is not None:
            return steps(table.steps)
        if table.ramp is not None:
            return ramp(table.ramp)
        if table.csv is not None:
            points = csv_points(folder / table.csv, table.column or name)
            return steps(points) if table.between == "hold" else ramp(points)
        return constant(table.constant or 0.0)
    except ValueError as error:
        raise SceneError(f"{source}: inputs.{name}: {error}") from error


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
