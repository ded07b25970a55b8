"""Arguments of the API: scenes, devices, FMUs and values, in every form that scripts may give."""

import warnings
from collections.abc import Mapping, Sequence
from inspect import currentframe
from numbers import Real
from pathlib import Path
from traceback import walk_stack
from typing import Any, SupportsFloat

from slider_resonator.device.device import Device
from slider_resonator.device.interface import settable_value
from slider_resonator.errors import HarnessError, explained
from slider_resonator.fmu.finished import fmu_path
from slider_resonator.scenes.device_file import possible_slips, read_device_file
from slider_resonator.scenes.scene import Scene, scene_from
from slider_resonator.scenes.scene_files import find_scene
from slider_resonator.scenes.schema import DeviceFileTable
from slider_resonator.scenes.table_reading import table_from

SceneLike = str | Path | Mapping[str, Any] | Scene
Value = SupportsFloat | str
"""A number in SI units, or a text with a unit."""
DeviceLike = str | Path | Device | Mapping[str, Value]


def read_scene(scene: SceneLike, **values: Value) -> Scene:
    """Return a scene, its parameters and inputs replaced by `values`.

    Data without a name is called "scene". Raises SceneError with key, value and requirement.
    """
    checked = values_of(values)
    if isinstance(scene, Scene):
        return scene.with_values(checked)
    if isinstance(scene, Mapping):
        named = {"name": "scene", "title": "scene", **plain(scene)}
        return scene_from(named, str(named["name"])).with_values(checked)
    return find_scene(str(scene), checked)


def scene_of(
    scene: SceneLike, parameters: Mapping[str, float], values: Mapping[str, Value]
) -> Scene:
    """Return a scene with the device of some parameters, and values on top."""
    return read_scene(scene).with_device(parameters).with_values(values_of(values))


def parameters_of(device: DeviceLike | None) -> dict[str, float]:
    """Return the parameters that a device states: of a `Device` those that differ from table 1."""
    if device is None:
        return {}
    if isinstance(device, Device):
        device = device.differing
    if isinstance(device, Mapping):
        table = table_from(DeviceFileTable, {"device": plain(device)}, "device")
        _warn(possible_slips(device))
        return table.device.stated
    read = read_device_file(str(device))
    _warn(read.slips)
    return read.values


def _warn(slips: Sequence[str]) -> None:
    """Warn of numbers that may be meant in another unit, where this package was called."""
    modules = [frame.f_globals.get("__name__", "") for frame, _ in walk_stack(currentframe())]
    inside = sum(name.startswith("slider_resonator.") for name in modules)
    for slip in slips:
        warnings.warn(slip, stacklevel=1 + inside)


def fmus_of(fmus: Sequence[str | Path]) -> list[Path]:
    """Return the paths of FMUs, by default of the native one of this installation."""
    return [fmu_of(fmu) for fmu in fmus or (None,)]


def fmu_of(fmu: str | Path | None) -> Path:
    """Return the path of an FMU, by default of the native one of this installation."""
    check_kind(str | Path, "a path", fmu=fmu)
    return fmu_path() if fmu is None else Path(fmu)


def values_of(values: Mapping[str, Value]) -> dict[str, float]:
    """Return parameters and inputs in SI units; HarnessError with name, value and requirement."""
    with explained():
        checked = {name: settable_value(name, value) for name, value in plain(values).items()}
    _warn(possible_slips(values))
    return checked


def plain(data: Any) -> Any:
    """Return data with arrays, ranges and tuples as lists, and numpy's numbers as Python's."""
    if isinstance(data, Mapping):
        return {key: plain(value) for key, value in data.items()}
    if hasattr(data, "tolist"):
        return data.tolist()
    return [plain(entry) for entry in data] if isinstance(data, list | tuple | range) else data


def check_kind(kind: Any, meaning: str, **arguments: Any) -> None:
    """Raise HarnessError for an argument that is given and is of another kind."""
    for name, value in arguments.items():
        if value is not None and not isinstance(value, kind):
            raise HarnessError(f"{name} = {value!r}: must be {meaning}")


def check_positive(**arguments: float | None) -> None:
    """Raise HarnessError for an argument that is given and is no number above 0."""
    for name, value in arguments.items():
        if value is not None and not (isinstance(value, Real) and value > 0):
            raise HarnessError(f"{name} = {value!r}: must be a number above 0")
