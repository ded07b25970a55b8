"""The built FMU with LuGre friction against the Taylor reference, from soft to hard bristles."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.lugre_taylor import simulate_lugre
from slider_resonator.references.resolved.trajectory import LugreTrajectory
from tests.fmu.host import Instance
from tests.fmus import both_fmus
from tests.problems import DURATION, SIGNALS

pytestmark = both_fmus

STIFFNESSES = (50.0, 1e4, 1e5, 1e6, 1e8)
CASES: dict[str, tuple[dict[str, float], dict[str, float]]] = {
    "table 1": ({}, {}),
    "ratio 3": ({}, {"frequency_ratio": 3.0, "phase": 0.4}),
    "presliding": ({"base_amplitude": 2e-8}, {}),
    "lift-off": ({"normal_amplitude": 2.0}, {"load": 0.02}),
    "one degree of freedom": ({"fidelity": 1.0, "friction_faces": 1.0}, {"phase": 0.3}),
}


@cache
def referee_of(
    parameters: tuple[tuple[str, float], ...],
    inputs: tuple[tuple[str, float], ...],
    duration: float,
) -> LugreTrajectory:
    """The reference at a hundred moments, for both FMUs."""
    device = Device.from_mapping(dict(parameters))
    held = HeldInputs(0.0, duration, **dict(inputs))
    return simulate_lugre(device, [held], np.linspace(0.0, duration, 101)[1:])


def deviations(
    instantiate: Callable[[], Instance],
    parameters: dict[str, float],
    inputs: dict[str, float],
    duration: float,
) -> dict[str, float]:
    """Largest deviation of each signal as a fraction of its peak; reversals as they differ."""
    times = np.linspace(0.0, duration, 101)[1:]
    reference = referee_of(tuple(parameters.items()), tuple(inputs.items()), duration)
    instance = instantiate().initialize(**parameters, **inputs)
    rows = []
    for time in times:
        instance.step(time - instance.time)
        rows.append(instance.get(*SIGNALS))
    found = {"reversals": instance.get("reversals")[0] - reference.reversals}
    for name, column in zip(SIGNALS, np.array(rows).T, strict=True):
        expected = getattr(reference, name)
        found[name] = float(np.abs(column - expected).max() / np.abs(expected).max())
    return found


@pytest.mark.parametrize("stiffness", STIFFNESSES)
@pytest.mark.parametrize("damping", [0.0, 10.0])
@pytest.mark.parametrize("case", CASES)
def test_against_the_referee(
    instantiate: Callable[[], Instance], stiffness: float, damping: float, case: str
) -> None:
    parameters, inputs = CASES[case]
    lugre = {"friction_law": 1.0, "bristle_stiffness": stiffness, "bristle_damping": damping}
    found = deviations(
        instantiate, {**parameters, **lugre, "tolerance": 1e-9}, inputs, DURATION / 4
    )
    assert found.pop("reversals") == 0, "reversals more than the reference has seen"
    assert max(found.values()) <= 1e-6, (
        f"deviations from the reference in shares of the peak: {found}"
    )


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", STIFFNESSES)
@pytest.mark.parametrize("case", CASES)
def test_against_the_referee_for_longer(
    instantiate: Callable[[], Instance], stiffness: float, case: str
) -> None:
    parameters, inputs = CASES[case]
    lugre = {"friction_law": 1.0, "bristle_stiffness": stiffness, "tolerance": 1e-9}
    found = deviations(instantiate, {**parameters, **lugre}, inputs, DURATION)
    assert found.pop("reversals") == 0, "reversals more than the reference has seen"
    assert max(found.values()) <= 1e-6, (
        f"deviations from the reference in shares of the peak: {found}"
    )
