"""Every output of the FMU has a reference in some built-in scene of each fidelity and law."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

import pytest

from slider_resonator.device.interface import OUTPUTS
from slider_resonator.scenes.scene import read_scene
from slider_resonator.scenes.scene_files import built_in_scenes

MODELS = list(product((0, 1, 2), (0, 1)))
"""Fidelity and friction law."""

SHOWN_BY: Mapping[str, Sequence[str]] = {
    **{
        name: (name,)
        for name in (
            *("position", "velocity", "resonator_displacement", "resonator_velocity"),
            *("normal_force", "friction_force", "contact_mode"),
        )
    },
    "mean_velocity": ("mean_velocity_in_run",),
    "reversals": ("reversals_in_run",),
    "stick_fraction": ("stick_fraction_in_run", "stick_fraction"),
    "last_event_time": ("event_times",),
    "steady_velocity": ("predicted_velocity_in_run",),
    "blocking_force": ("predicted_blocking_force_in_run",),
}
"""Output to the quantities that compare it."""


@pytest.fixture(scope="module")
def compared() -> dict[tuple[int, int], set[str]]:
    """The quantities that built-in scenes compare, by fidelity and friction law."""
    found: dict[tuple[int, int], set[str]] = {model: set() for model in MODELS}
    for file in built_in_scenes().values():
        scene = read_scene(file)
        for point in scene.points():
            device = point.scene.device
            model = device.fidelity, device.friction_law
            found[model] |= {expect.quantity for expect in scene.expect}
    return found


@pytest.mark.parametrize("output", OUTPUTS)
@pytest.mark.parametrize(("fidelity", "law"), MODELS)
def test_every_output_is_compared_at_each_fidelity_and_law(
    compared: dict[tuple[int, int], set[str]], output: str, fidelity: int, law: int
) -> None:
    assert compared[fidelity, law] & set(SHOWN_BY[output])
