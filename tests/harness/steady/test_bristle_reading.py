"""Reading the bristle from friction and path, on motions whose bristle is known."""

from __future__ import annotations

from dataclasses import replace
from math import pi, tau

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUT_STARTS
from slider_resonator.errors import FmuError
from slider_resonator.steady.bristle_reading import BristleReading, bristle_reading

RATE = 3500.0
VALUES = {**vars(Device(friction_law=1, bristle_stiffness=1e4)), **INPUT_STARTS}


def reading_of(**changed: float) -> BristleReading:
    reading = bristle_reading({**VALUES, **changed})
    assert reading is not None
    return reading


def read_and_true(drift: float, lag: float, **changed: float) -> tuple[float, float]:
    """Return the deflection that is read, and the true one, at the end of two drive periods.

    The velocity is that of a device in steady motion, drift - 0.24 cos(theta - lag).
    """
    values = {**VALUES, **changed}
    reading = reading_of(**changed)
    stiffness, coefficient = values["bristle_stiffness"], values["friction_coefficient"]

    def velocity(time: float | np.ndarray) -> float | np.ndarray:
        return drift - 0.24 * np.cos(RATE * time - lag)

    def slope(time: float, bent: np.ndarray) -> np.ndarray:
        v = velocity(time)
        return np.asarray(stiffness * (v - np.abs(v) * bent / coefficient))

    stop = 2.0 * tau / RATE
    times = stop - np.array(reading.leads)
    solved = solve_ivp(
        slope, (0.0, stop), [0.0], t_eval=times, rtol=1e-12, atol=1e-14, max_step=stop / 500
    )
    bent, v = solved.y[0], np.asarray(velocity(times))
    position = drift * times - 0.24 / RATE * np.sin(RATE * times - lag)
    angle = values["frequency_ratio"] * RATE * times + values["phase"]
    normal = np.maximum(0.0, values["normal_preload"] + values["normal_amplitude"] * np.sin(angle))
    drag = values["bristle_damping"] * (v - np.abs(v) * bent / coefficient)
    friction = values["friction_faces"] * normal * (bent + drag)
    return reading.deflection(times, position, v, friction, normal), float(bent[-1] / stiffness)


@pytest.mark.parametrize(("stiffness", "lag"), [(50.0, 0.7), (1e6, 1.4), (1e4, 2.0), (50.0, -1.6)])
@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"phase": -pi / 2.0},
        {"phase": -1.2, "normal_amplitude": 3.0},
        {"phase": -0.35, "normal_amplitude": 3.0},
        {"phase": 4.4, "normal_amplitude": 30.0, "frequency_ratio": -1.0},
        {"phase": 0.0, "normal_preload": 0.0},
        {"phase": -1.0, "normal_amplitude": 2.0, "frequency_ratio": 0.5},
    ],
)
def test_deflection_is_read_in_every_contact(
    stiffness: float, changed: dict[str, float], lag: float
) -> None:
    """Lags near +-pi / 2 put a reversal just before the end, in flight where it is lifted."""
    read, true = read_and_true(0.05, lag, bristle_stiffness=stiffness, **changed)
    assert read == pytest.approx(true, abs=1e-9 * 0.1 / stiffness)


def test_deflection_is_read_where_friction_does_not_depend_on_it() -> None:
    """At |v| = mu / sigma_1 the deflection drops out of (8)."""
    speed = abs(0.05 - 0.24 * np.cos(0.7))
    read, true = read_and_true(0.05, 0.7, bristle_damping=0.1 / speed, bristle_stiffness=50.0)
    assert read == pytest.approx(true, abs=1e-9 * 0.1 / 50.0)


def test_open_contact_cannot_be_read() -> None:
    reading = replace(reading_of(), leads=(1e-4, 0.0))
    zeros, ones = np.zeros(2), np.ones(2)
    with pytest.raises(FmuError, match="cannot be read"):
        reading.deflection(np.array([1.0, 2.0]), ones, ones, zeros, zeros)


@pytest.mark.parametrize(
    "changed",
    [
        {"friction_law": 0.0},
        {"fidelity": 0.0},
        {"friction_coefficient": 0.0},
        {"bristle_stiffness": 0.0},
        {"friction_faces": 0.0},
        {"normal_preload": 0.0, "normal_amplitude": 0.0},
        {"frequency_ratio": 0.0, "phase": -pi / 2.0, "normal_amplitude": 2.0},
    ],
)
def test_no_bristle_is_read_without_bristle_friction(changed: dict[str, float]) -> None:
    assert bristle_reading({**VALUES, **changed}) is None


def test_readings_reach_back_to_contact_within_the_period() -> None:
    flight = reading_of(phase=-pi / 2.0 + 0.6, normal_amplitude=3.0)
    lift_off = (pi / 2.0 + 0.6 - np.arcsin(1.0 / 3.0)) / RATE
    assert flight.leads[-1] == 0.0
    assert lift_off < flight.leads[0] < tau / RATE
    assert reading_of().leads[0] < 0.1 * tau / RATE, "a closed contact is read at the end"
