"""What the built-in scenes try: an FMU that ignores a value in one of its models is noticed."""

from __future__ import annotations

from collections import defaultdict

from slider_resonator.device.interface import HELD, INPUTS
from slider_resonator.scenes.scene_files import built_in_scenes, find_scenes

MOTION = {"position", "velocity", "mean_velocity", "mean_velocity_in_run"}


def test_every_value_changes_in_a_run_of_every_model() -> None:
    changed: defaultdict[tuple[int, int | str], set[str]] = defaultdict(set)
    for scene in find_scenes(list(built_in_scenes())):
        for point in scene.points():
            own, device = point.scene, point.scene.device
            if MOTION & {expect.quantity for expect in own.expect if expect.reference}:
                model = (device.friction_law, device.fidelity or f"order {device.averaging_order}")
                signals = {**own.signals, **own.tuning}
                changed[model] |= {n for n, s in signals.items() if len(set(s.values)) > 1}
    assert len(changed) == 8, "two friction laws at two fidelities and by two orders of averages"
    missing = {model: {*HELD, *INPUTS} - names for model, names in changed.items()}
    assert not any(missing.values()), f"no scene changes {missing}"
