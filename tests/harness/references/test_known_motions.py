"""Motions with closed forms, which every integrator must reproduce."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import STICK
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory

Array = NDArray[np.float64]

FREQUENCY = 3500.0
AMPLITUDE = 1e-4
STOP = 0.2


@dataclass(frozen=True)
class KnownMotion:
    """A device under constant inputs over [0, STOP] s, and one of its signals in closed form."""

    parameters: dict[str, float]
    inputs: dict[str, Any]
    signal: str
    exact: Callable[[Array], Array]
    event_times: tuple[float, ...] = ()
    sticks: int = 0

    @property
    def device(self) -> Device:
        return Device.from_mapping(self.parameters)

    @property
    def held(self) -> list[HeldInputs]:
        return [HeldInputs(0.0, STOP, **self.inputs)]


def _stopping(time: Array) -> Array:
    sliding = np.minimum(time, 0.1)
    return 0.02 * sliding - 0.1 * sliding**2


def _secular(time: Array) -> Array:
    """Undamped oscillator driven at its own frequency from rest."""
    turned = FREQUENCY * time
    return 0.5 * AMPLITUDE * (np.sin(turned) - turned * np.cos(turned))


def _recoil(time: Array) -> Array:
    """Velocity of a free slider: the base excitation gives momentum, the resonator takes some."""
    turned = FREQUENCY * time
    resonator_velocity = 0.5 * AMPLITUDE * FREQUENCY * turned * np.sin(turned)
    momentum = 0.1 * AMPLITUDE * FREQUENCY * (1.0 - np.cos(turned))
    return (momentum - 0.1 * resonator_velocity) / 1.1


def _breaking_loose(time: Array) -> Array:
    """Velocity under 0.4 sin(w t) N against 0.2 N of friction, from the first release on."""
    release = np.pi / 6.0
    turned = np.maximum(FREQUENCY * time, release)
    push = 0.4 * (np.cos(release) - np.cos(turned)) - 0.2 * (turned - release)
    return np.where(push > 0.0, push, 0.0) / FREQUENCY


_RIGID = {"resonator_mass": 0.0, "base_amplitude": 0.0, "normal_amplitude": 0.0}
_BUILT_IN = {"friction_coefficient": 1e6, "normal_amplitude": 0.0, "damping_ratio": 0.0}
_FREE = {"normal_preload": 0.0, "normal_amplitude": 0.0}

KNOWN_MOTIONS = {
    "constant friction slides to a stop and sticks": KnownMotion(
        _RIGID | {"initial_velocity": 0.02}, {}, "position", _stopping, (0.1,), sticks=1
    ),
    "free flight under a load": KnownMotion(
        _RIGID | _FREE | {"initial_velocity": 0.3, "initial_position": -1.0},
        {"load": 0.5},
        "position",
        lambda time: -1.0 + 0.3 * time - 0.25 * time**2,
    ),
    "undamped resonator on a held slider at resonance": KnownMotion(
        _BUILT_IN, {}, "resonator_displacement", _secular
    ),
    "undamped resonator on a free slider at resonance": KnownMotion(
        _FREE | {"damping_ratio": 0.0, "resonator_frequency": FREQUENCY * np.sqrt(1.0 / 1.1)},
        {},
        "resonator_displacement",
        _secular,
    ),
    "recoil of a free slider at resonance": KnownMotion(
        _FREE | {"damping_ratio": 0.0, "resonator_frequency": FREQUENCY * np.sqrt(1.0 / 1.1)},
        {},
        "velocity",
        _recoil,
    ),
    "lifting off and touching down without any force": KnownMotion(
        {"base_amplitude": 0.0, "normal_amplitude": 2.0, "drive_frequency": 40.0},
        {},
        "normal_force",
        lambda time: np.maximum(0.0, 1.0 + 2.0 * np.sin(40.0 * time)),
        (7.0 * np.pi / 240.0, 11.0 * np.pi / 240.0),
        sticks=1,
    ),
}

FIRST_SLIP = KnownMotion(
    _RIGID | {"tangential_force": 0.4}, {}, "velocity", _breaking_loose, (np.pi / 6.0 / FREQUENCY,)
)
"""Breaks loose from a stick; in closed form until 3.5 rad of the first drive period."""


TIMES = np.linspace(0.0, STOP, 701)
ALLOWED = 2e-13
"""Deviation in fractions of the peak."""


def deviation(run: Trajectory, signal: str, exact: np.ndarray) -> float:
    return float(np.abs(getattr(run, signal) - exact).max() / np.abs(exact).max())


@pytest.mark.parametrize("name", KNOWN_MOTIONS)
def test_motion_matches_the_closed_form(name: str) -> None:
    motion = KNOWN_MOTIONS[name]
    run = simulate(motion.device, motion.held, TIMES)
    found = deviation(run, motion.signal, motion.exact(TIMES))
    assert found <= ALLOWED, f"{name}: {motion.signal} deviates by {found:.1e} of its peak"
    assert run.event_times == pytest.approx(motion.event_times, rel=1e-12), (
        f"{name}: instants of the changes of contact mode"
    )
    assert np.count_nonzero(run.modes[1:] == STICK) == motion.sticks, f"{name}: number of sticks"
    assert run.reversals == 0, f"{name}: nothing here turns round"


def test_slider_breaks_loose_where_the_drive_exceeds_friction() -> None:
    times = np.linspace(0.0, 3.5 / FREQUENCY, 301)
    run = simulate(FIRST_SLIP.device, FIRST_SLIP.held, times)
    assert deviation(run, "velocity", FIRST_SLIP.exact(times)) <= ALLOWED
    assert run.event_times[0] == pytest.approx(FIRST_SLIP.event_times[0], rel=1e-13), (
        "0.4 sin(w t) N reaches 0.2 N of friction at w t = pi / 6"
    )
    assert run.contact_mode[np.searchsorted(times, run.event_times[0])] == 1
