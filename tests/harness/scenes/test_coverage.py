"""What the built-in scenes try: an FMU that ignores a value in one of its models is noticed."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator

from slider_resonator.device.interface import HELD, INPUTS, PARAMETERS, VARIABLES
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import built_in_scenes, find_scenes

MOTION = {"position", "velocity", "mean_velocity", "mean_velocity_in_run"}
Model = tuple[int, int | str]
"""Friction law, and fidelity or order of averages."""
MODELS: dict[Model, set[str]] = {
    (law, level): {
        *({"bristle_stiffness", "bristle_damping"} if law == 0 else ()),
        *({"initial_bristle_deflection"} if law == 0 or level == "order 1" else ()),
        *({"tolerance"} if level == "order 1" or (law == 0 and level in (1, 2)) else ()),
    }
    for law in (0, 1)
    for level in (1, 2, "order 1", "order 2")
}
"""Models, and parameters that mean nothing to them."""


def tried(values: Callable[[Scene], Iterator[str]]) -> dict[Model, set[str]]:
    """The names that `values` gives of scenes whose motion is compared with a reference."""
    found: dict[Model, set[str]] = defaultdict(set)
    for scene in find_scenes(list(built_in_scenes())):
        for point in scene.points():
            device = point.scene.device
            if MOTION & {expect.quantity for expect in scene.expect if expect.reference}:
                level = device.fidelity or f"order {device.averaging_order}"
                found[device.friction_law, level] |= {*values(point.scene)}
    assert set(found) == set(MODELS)
    return found


def test_every_value_changes_in_a_run_of_every_model() -> None:
    def changed(scene: Scene) -> Iterator[str]:
        signals = {**scene.signals, **scene.tuning}
        return (name for name, signal in signals.items() if len(set(signal.values)) > 1)

    missing = {model: {*HELD, *INPUTS} - names for model, names in tried(changed).items()}
    assert not any(missing.values()), f"no scene changes {missing}"


def test_no_parameter_keeps_its_start_in_all_scenes_of_a_model() -> None:
    def other(scene: Scene) -> Iterator[str]:
        return (name for name, value in scene.parameters.items() if value != VARIABLES[name].start)

    chosen = {"fidelity", "averaging_order", "friction_law"}
    missing = {m: {*PARAMETERS} - chosen - MODELS[m] - names for m, names in tried(other).items()}
    assert not any(missing.values()), f"no scene has another value of {missing}"
