"""Motion averaged to second order in the built FMU against the full device in the same FMU."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

W = 3500.0
FAST_VELOCITY = 0.2366097
Inputs = Mapping[str, float]


@dataclass(frozen=True)
class Errors:
    """Largest ones at the ends of steps: of mean velocity m/s and position m; and the peak."""

    velocity: float
    travel: float
    peak: float


def errors(
    instantiate: Instantiate,
    values: Mapping[str, float],
    periods: int,
    steps: int,
    inputs: Callable[[int], Inputs] = lambda _: {},
) -> Errors:
    slow = instantiate().initialize(**{**values, "fidelity": 0})
    full = instantiate().initialize(**{**values, "fidelity": 2})
    step = periods * math.tau / values.get("drive_frequency", W) / steps
    gaps, ways, means = [], [], []
    for i in range(steps):
        for instance in (slow, full):
            instance.set(**inputs(i))
            instance.step(step)
        mean, position = slow.get("mean_velocity", "position")
        reference, place = full.get("mean_velocity", "position")
        gaps.append(abs(mean - reference))
        ways.append(abs(position - place))
        means.append(abs(reference))
    return Errors(max(gaps), max(ways), max(means))


@pytest.mark.parametrize("steps", [5, 100, 5014])
def test_table_1_from_rest(instantiate: Instantiate, steps: int) -> None:
    found = errors(instantiate, {}, 5014, steps)
    assert found.velocity <= 5e-7 * found.peak, "over 9 s"
    assert found.travel <= 1e-8, "of 1.0 m"


@pytest.mark.parametrize(
    ("values", "periods", "allowed"),
    [
        ({"friction_coefficient": 1.0}, 600, 1.5e-7),
        ({"friction_coefficient": 5.0}, 200, 7.7e-7),
        ({"friction_coefficient": 1.0, "phase": 0.7, "load": 0.3}, 600, 1.5e-7),
        (
            {"friction_coefficient": 1.0, "phase": 0.7, "load": 0.3, "normal_amplitude": 1.8},
            600,
            5e-7,
        ),
        ({"frequency_ratio": 3.0, "phase": 0.4}, 800, 1e-8),
        ({"frequency_ratio": 1.5, "phase": 0.4, "normal_amplitude": 2.0}, 800, 2e-8),
        ({"frequency_ratio": 1.001}, 2000, 1e-8),
        ({"frequency_ratio": 1.001, "friction_coefficient": 1.0}, 2000, 1e-5),
        ({"frequency_ratio": 1.001, "normal_amplitude": 1.7}, 2000, 1e-7),
        ({"friction_law": 1, "tolerance": 1e-10}, 800, 1e-7 * FAST_VELOCITY),
        (
            {"friction_law": 1, "tolerance": 1e-10, "bristle_stiffness": 1e4},
            800,
            1e-7 * FAST_VELOCITY,
        ),
        (
            {"friction_law": 1, "tolerance": 1e-10, "bristle_stiffness": 1e7},
            800,
            1e-7 * FAST_VELOCITY,
        ),
    ],
)
def test_devices(
    instantiate: Instantiate, values: dict[str, float], periods: int, allowed: float
) -> None:
    assert errors(instantiate, values, periods, 40).velocity <= allowed


@pytest.mark.parametrize(("friction", "allowed"), [(0.1, 1e-6), (1.0, 1e-5)])
def test_inputs_that_jump(instantiate: Instantiate, friction: float, allowed: float) -> None:
    """Each 50 periods, 60 times; in each period the resonator's own swing after a jump is there."""

    def inputs(i: int) -> Inputs:
        jump = i // 25
        return {"phase": float(jump % 2), "load": (0.0, 0.05, -0.04)[jump % 3]}

    found = errors(instantiate, {"friction_coefficient": friction}, 3000, 1500, inputs)
    assert found.velocity <= allowed
    assert found.travel <= allowed


def test_a_phase_that_keeps_changing(instantiate: Instantiate) -> None:
    def inputs(i: int) -> Inputs:
        return {"phase": 0.5 * math.sin(0.1 * i) + 0.01 * i, "load": 0.03 * math.sin(0.07 * i)}

    assert errors(instantiate, {}, 3000, 300, inputs).velocity <= 1e-6


@pytest.mark.parametrize("fidelity", [0, 1, 2])
@pytest.mark.parametrize(
    ("values", "velocity", "force"),
    [
        ({}, 0.126666997, 0.0851861),
        ({"phase": 0.4, "load": 0.05}, 0.0986951, None),
        ({"phase": 0.4, "frequency_ratio": 3.0}, -0.0362968, None),
    ],
)
def test_predictions_are_exact(
    instantiate: Instantiate,
    fidelity: int,
    values: dict[str, float],
    velocity: float,
    force: float | None,
) -> None:
    """Against the steady motion of the full device, found by long simulation with other methods."""
    instance = instantiate().initialize(fidelity=fidelity, **values)
    steady, blocking = instance.get("steady_velocity", "blocking_force")
    assert steady == pytest.approx(velocity, rel=2e-6)
    assert force is None or blocking == pytest.approx(force, rel=2e-6)
    first = instantiate().initialize(fidelity=fidelity, averaging_order=1, **values)
    assert abs(first.get("steady_velocity")[0] - steady) > 1e-5


@pytest.mark.parametrize(
    "values", [{}, {"friction_law": 1}, {"frequency_ratio": 1.5, "normal_amplitude": 2.0}]
)
def test_steady_motion_is_that_of_the_prediction(
    instantiate: Instantiate, values: dict[str, float]
) -> None:
    """The full device, begun with the state predicted, keeps its velocity over two turns."""
    values = {**values, "phase": 0.4}
    turn = math.tau / W
    slow = instantiate().initialize(**values, fidelity=0)
    slow.step(22_000 * turn)
    names = ("velocity", "resonator_displacement", "resonator_velocity")
    initial = dict(zip(names, slow.get(*names), strict=True))
    full = instantiate().initialize(**values, **{f"initial_{n}": v for n, v in initial.items()})
    full.step(20 * turn)
    steady = slow.get("steady_velocity")[0]
    for instance, allowed in ((slow, 1e-9), (full, 2e-6)):
        means = []
        for _ in range(2):
            instance.step(turn)
            means.append(instance.get("mean_velocity")[0])
        assert sum(means) / 2.0 == pytest.approx(steady, abs=allowed)
