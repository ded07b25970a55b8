"""Predictions that are proved are those of shooting; what the FMU gets wrong is not proved."""

import random
from collections.abc import Mapping
from dataclasses import replace

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.steady import proved_predictions as module
from slider_resonator.steady.proved_predictions import proved_predictions
from slider_resonator.steady.searches import find_blocking, find_steady


def devices(count: int) -> list[dict[str, float]]:
    """Return devices with all kinds of resonators and friction, and some with a load."""
    draw = random.Random(7)
    return [
        {
            "frequency_ratio": draw.choice([1.0, 2.0, 3.0, 0.5, 1.5, 4.0 / 3.0]),
            "phase": draw.uniform(-3.0, 3.0),
            "friction_coefficient": 10.0 ** draw.uniform(-2.5, 0.5),
            "normal_amplitude": draw.uniform(0.0, 1.6),
            "damping_ratio": 10.0 ** draw.uniform(-2.0, 0.0),
            "resonator_frequency": 3500.0 * 10.0 ** draw.uniform(-0.3, 0.3),
            "tangential_force": draw.uniform(0.0, 50.0),
        }
        for _ in range(count)
    ]


def test_they_are_those_of_shooting(instance: Instance) -> None:
    free = devices(12)
    loaded = [{**one, "load": 0.01 * (n % 3)} for n, one in enumerate(free)]
    velocities = proved_predictions(instance, "steady_velocity", loaded, 20)
    forces = proved_predictions(instance, "blocking_force", free, 20)
    assert forces == proved_predictions(instance, "blocking_force", loaded, 20)
    for proved in (velocities, forces):
        assert sum(value is not None for value in proved) >= 8
    for values, velocity in zip(loaded, velocities, strict=True):
        if velocity is not None:
            found = find_steady(instance, values)
            assert found.status == "steady", values
            assert velocity == pytest.approx(found.steady_velocity, abs=1e-10), values
    for values, force in zip(free, forces, strict=True):
        if force is not None:
            blocking = find_blocking(instance, values)
            assert blocking.status == "blocked", values
            assert force == pytest.approx(blocking.blocking_force, abs=1e-10), values


@pytest.mark.parametrize(
    "values",
    [
        {"averaging_order": 1},
        {"fidelity": 0},
        {"fidelity": 1},
        {"friction_law": 1},
        {"frequency_ratio": 1.37},
        {"load": 1.0},
        {"base_amplitude": 1e-9, "normal_amplitude": 0.1},
        {"initial_velocity": 0.5},
        {"friction_coefficient": -1.0},
    ],
)
def test_other_predictions_are_not_proved(instance: Instance, values: Mapping[str, float]) -> None:
    refused, sound = proved_predictions(instance, "steady_velocity", [values, {}], 20)
    assert refused is None
    assert sound == pytest.approx(0.126666997, abs=1e-9), "design 2.7"


@pytest.mark.parametrize("error", [1e-5, 1e-4, 0.01])
def test_wrong_velocity(instance: Instance, monkeypatch: pytest.MonkeyPatch, error: float) -> None:
    """As much as v_q times `error`, which is some 0.26 m/s."""
    read = module._candidate

    def wrong(*arguments: object) -> module._Candidate | None:
        one = read(*arguments)  # type: ignore[arg-type]
        return one and replace(one, velocity=one.velocity + error * one.scale[0])

    monkeypatch.setattr(module, "_candidate", wrong)
    assert proved_predictions(instance, "steady_velocity", [{}, {"phase": 0.4}], 20) == [None] * 2


def test_slow_motions_are_proved_too(instance: Instance) -> None:
    """Where a period changes the slow velocity by less than a thousandth of what it is off by."""
    slow = [{"frequency_ratio": 2.0, "phase": phase} for phase in (0.142, 0.268, 0.394, 0.52)]
    proved = proved_predictions(instance, "steady_velocity", slow, 20)
    for values, velocity in zip(slow, proved, strict=True):
        assert velocity == pytest.approx(0.0, abs=1e-9), f"by symmetry, {values}"


def test_each_quantity_is_predicted_by_itself(instance: Instance) -> None:
    """The steady motion of this device repeats, though no single load is found that blocks it."""
    held = {
        "phase": 0.38668099944118417,
        "load": 0.2870146635603288,
        "friction_coefficient": 10.84295972505037,
        "normal_amplitude": 0.6929569152692459,
        "resonator_frequency": 1138.806110654186,
        "damping_ratio": 0.06049979809842225,
    }
    found = find_steady(instance, held)
    assert found.status == "steady"
    assert found.prediction_valid is False
    assert found.predicted == pytest.approx(found.steady_velocity, rel=1e-9)
    proved = proved_predictions(instance, "steady_velocity", [held], 20)
    assert proved == [pytest.approx(found.steady_velocity, rel=1e-9)]
