"""Motions with closed forms, which the reference must reproduce."""

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import STICK
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory

FREQUENCY = 3500.0
AMPLITUDE = 1e-4
STOP = 0.2
TIMES = np.linspace(0.0, STOP, 701)
TURNED = FREQUENCY * TIMES
ALLOWED = 2e-13
"""Deviation in fractions of the peak."""

RIGID = {"resonator_mass": 0.0, "base_amplitude": 0.0, "normal_amplitude": 0.0}
FREE = {"normal_preload": 0.0, "normal_amplitude": 0.0}
BUILT_IN = {"friction_coefficient": 1e6, "normal_amplitude": 0.0, "damping_ratio": 0.0}
RESONANT = {"damping_ratio": 0.0, "resonator_frequency": FREQUENCY * np.sqrt(1.0 / 1.1)}
OPENING = {"base_amplitude": 0.0, "normal_amplitude": 2.0, "drive_frequency": 40.0}

SLIDING = np.minimum(TIMES, 0.1)
SECULAR = 0.5 * AMPLITUDE * (np.sin(TURNED) - TURNED * np.cos(TURNED))
"""Undamped oscillator driven at its own frequency from rest."""
MOMENTUM = 0.1 * AMPLITUDE * FREQUENCY * (1.0 - np.cos(TURNED))
"""Of the base excitation; a free slider has it less that of the resonator."""
RECOIL = (MOMENTUM - 0.1 * 0.5 * AMPLITUDE * FREQUENCY * TURNED * np.sin(TURNED)) / 1.1


def deviation(run: Trajectory, signal: str, exact: Array) -> float:
    return float(np.abs(getattr(run, signal) - exact).max() / np.abs(exact).max())


@pytest.mark.parametrize(
    ("parameters", "load", "signals", "event_times", "sticks"),
    [
        pytest.param(
            *(RIGID | {"initial_velocity": 0.02}, 0.0),
            *({"position": 0.02 * SLIDING - 0.1 * SLIDING**2}, [0.1], 1),
            id="constant friction slides to a stop and sticks",
        ),
        pytest.param(
            *(RIGID | FREE | {"initial_velocity": 0.3, "initial_position": -1.0}, 0.5),
            *({"position": -1.0 + 0.3 * TIMES - 0.25 * TIMES**2}, [], 0),
            id="free flight under a load",
        ),
        pytest.param(
            *(BUILT_IN, 0.0, {"resonator_displacement": SECULAR}, [], 0),
            id="undamped resonator on a held slider at resonance",
        ),
        pytest.param(
            *(FREE | RESONANT, 0.0),
            *({"resonator_displacement": SECULAR, "velocity": RECOIL}, [], 0),
            id="undamped resonator on a free slider at resonance, with its recoil",
        ),
        pytest.param(
            *(OPENING, 0.0, {"normal_force": np.maximum(0.0, 1.0 + 2.0 * np.sin(40.0 * TIMES))}),
            *([7.0 * np.pi / 240.0, 11.0 * np.pi / 240.0], 1),
            id="lifting off and touching down without any force",
        ),
    ],
)
def test_motion_matches_the_closed_form(
    parameters: dict[str, float],
    load: float,
    signals: dict[str, Array],
    event_times: list[float],
    sticks: int,
) -> None:
    run = simulate(Device.from_mapping(parameters), [HeldInputs(0.0, STOP, load=load)], TIMES)
    for signal, exact in signals.items():
        assert deviation(run, signal, exact) <= ALLOWED, signal
    assert run.event_times == pytest.approx(event_times, rel=1e-12), "changes of contact mode"
    assert np.count_nonzero(run.modes[1:] == STICK) == sticks
    assert run.reversals == 0, "nothing here turns round"


def test_slider_breaks_loose_where_the_drive_exceeds_friction() -> None:
    """0.4 sin(w t) N reaches 0.2 N of friction at w t = pi / 6; before the first reversal."""
    times = np.linspace(0.0, 3.5 / FREQUENCY, 301)
    device = Device.from_mapping(RIGID | {"tangential_force": 0.4})
    run = simulate(device, [HeldInputs(0.0, STOP)], times)
    release = np.pi / 6.0
    turned = np.maximum(FREQUENCY * times, release)
    push = 0.4 * (np.cos(release) - np.cos(turned)) - 0.2 * (turned - release)
    assert deviation(run, "velocity", np.maximum(push, 0.0) / FREQUENCY) <= ALLOWED
    assert run.event_times[0] == pytest.approx(release / FREQUENCY, rel=1e-13)
    assert run.contact_mode[np.searchsorted(times, run.event_times[0])] == 1
