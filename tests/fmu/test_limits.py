"""Motion at its limits: events next to others, no preload, long steps, work that is bounded."""

import math
import time
from pathlib import Path

import pytest

from tests.fmu.host import OUTPUTS, Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

NO_PRELOAD = {"normal_preload": 0.0}


def test_a_release_by_an_input_is_the_last_event(instantiate: Instantiate) -> None:
    """Where the parts of the step sum up to more than it by rounding, too."""
    instance = instantiate().initialize(base_amplitude=0.0, resonator_mass=0.0)
    instance.step(1e-3)
    instance.set(load=5.0)
    stuck, released = instance.state(), instance.time
    for k in range(400):
        instance.restore(stuck)
        instance.time = released
        instance.step(0.02 + 0.000471 * k)
        mode, event = instance.get("contact_mode", "last_event_time")
        assert mode == -1.0
        assert event == pytest.approx(released, abs=1e-12)


@pytest.mark.parametrize(
    "device",
    [
        {"damping_ratio": 0.23416453451909713, "resonator_mass": 0.01242897871348076, **NO_PRELOAD},
        {"phase": 3.895139822727085, "drive_frequency": 8.5, "resonator_frequency": 53769.0},
        {"frequency_ratio": 0.0, **NO_PRELOAD},
        {"phase": -2.1758310349471994, **NO_PRELOAD},
    ],
)
@pytest.mark.parametrize("force", [-1.0, -0.3, 0.3, 1.0])
def test_a_start_from_rest_in_flight_is_no_reversal(
    instantiate: Instantiate, device: dict[str, float], force: float
) -> None:
    """The acceleration begins at zero, and rounding may give it either sign."""
    flight = {"friction_law": 1, "normal_amplitude": 2.0, "phase": -math.pi / 2} | device
    instance = instantiate().initialize(base_amplitude=0.0, tangential_force=force, **flight)
    instance.step(1e-5)
    velocity, *found = instance.get("velocity", "contact_mode", "reversals")
    assert math.copysign(1.0, velocity) == math.copysign(1.0, force)
    assert found == [2.0, 0.0]


@pytest.mark.parametrize("before", [1e-9, 1e-11, 1e-12, 1e-13, 1e-14])
def test_a_slide_just_before_the_contact_lifts_is_a_reversal(
    instantiate: Instantiate, before: float
) -> None:
    """However short it is, and though its travel may be lost in rounding."""
    instance = instantiate().initialize(
        base_amplitude=0.0, initial_velocity=1e-5, normal_amplitude=2.0, resonator_mass=0.0
    )
    lifts = (math.pi + math.pi / 6.0) / 3500.0
    instance.step(lifts - before)
    assert instance.get("contact_mode", "reversals") == (0.0, 0.0)
    instance.set(load=0.1)
    instance.step(2.0 * before)
    assert instance.get("contact_mode", "reversals") == (2.0, 1.0)


@pytest.mark.parametrize("law", [0, 1])
def test_a_first_slide_is_no_reversal_whatever_the_load_was_before(
    instantiate: Instantiate, law: int
) -> None:
    """Some hosts set inputs only after initialization, which may end under one that pushes."""
    still = {"base_amplitude": 0.0, "resonator_mass": 0.0, "friction_law": law}
    instance = instantiate().initialize(load=10.0, **still)
    instance.set(load=-10.0)
    instance.step(1e-3)
    assert instance.get("contact_mode", "reversals") == (1.0, 0.0)


@pytest.mark.parametrize("preload", [0.0, 5e-324, 1e-17])
@pytest.mark.parametrize("ratio", [1.0, -1.0, 0.75, 100.0])
def test_friction_of_bristles_with_next_to_no_preload(
    instantiate: Instantiate, preload: float, ratio: float
) -> None:
    """The kinks of the load are then an exact half turn apart, and meet where sliding turns."""
    values = {"fidelity": 0, "averaging_order": 1, "friction_law": 1, "normal_amplitude": 1.0}
    for phase in (0.0, math.pi, -math.pi, math.pi / 2.0, 0.3):
        for velocity in (-0.144, -1.0, 0.2366097 - 0.0318182):
            start = {"normal_preload": preload, "phase": phase, "initial_velocity": velocity}
            instance = instantiate().initialize(**values, **start, frequency_ratio=ratio)
            (force,) = instance.get("friction_force")
            assert abs(force) <= 2.0 * (0.1 + 10.0 * 0.5) / math.pi


@pytest.mark.parametrize(
    "device", [{"frequency_ratio": 0.01}, {"resonator_frequency": 50.0}, {"drive_frequency": 5e5}]
)
def test_without_any_force_the_slider_rests(
    instantiate: Instantiate, device: dict[str, float]
) -> None:
    """By series, too, whose terms are all zero."""
    free = {"normal_preload": 0.0, "normal_amplitude": 0.0, "base_amplitude": 0.0}
    instance = instantiate().initialize(**free, **device)
    instance.step(1.0)
    assert instance.get("position", "velocity") == (0.0, 0.0)


W = 3500.0
PERIOD = math.tau / W
WEAK = {"fidelity": 0, "averaging_order": 1, "base_amplitude": 1e-10}
"""The drive is some millionth of friction: slow motion settles a million times in ten periods."""

MANY_WAVES = {"normal_amplitude": 2.0, "frequency_ratio": 100.05}


def test_a_step_of_too_much_work_is_refused(instantiate: Instantiate) -> None:
    """Near a whole ratio the slow velocity follows the phase, and never settles."""
    instance = instantiate().initialize(**WEAK, frequency_ratio=1.05)
    work = ("more work than", "00 steps of averaged motion", "must be at most 1e")
    with instance.refuses("communicationStepSize = 1000.0 refused", *work):
        instance.step(1e3)
    instance.step(1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("values", "turns"),
    [
        ({}, 3e7),
        ({"friction_law": 1}, 3e6),
        ({"friction_law": 1}, 3e7),
        ({"friction_law": 1, "fidelity": 0, **MANY_WAVES}, 3e7),
        ({"normal_preload": 0.0, "normal_amplitude": 0.0}, 1e9),
    ],
    ids=["Coulomb", "bristles", "bristles, refused by turns", "quadratures", "no events"],
)
def test_no_step_takes_more_than_some_seconds(
    instantiate: Instantiate, fmu: Path, values: dict[str, float], turns: float
) -> None:
    # Some seconds in Python; at most 2 in C, and a margin for a busy machine.
    longest = 20.0 if fmu.stem == "SliderResonatorPy" else 3.0
    instance = instantiate().initialize(phase=0.4, **values)
    instance.step(1e-3)
    before = instance.get(*OUTPUTS)
    for size in (turns * PERIOD, 1e300):
        began = time.process_time()
        with instance.refuses(f"communicationStepSize = {size!r} refused", "at most"):
            instance.step(size)
        assert time.process_time() - began < longest
        assert instance.get(*OUTPUTS) == before, "a refusal leaves the state as it was"
    instance.step(1e-3)


def test_motion_beyond_the_range_of_numbers_is_refused(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(initial_velocity=1e308)
    with instance.refuses("leaves the range of floating point numbers"):
        instance.step(10.0)


@pytest.mark.parametrize(
    ("device", "size"),
    [
        ({"frequency_ratio": 0.015, "friction_coefficient": 5.0}, 0.01),
        ({"frequency_ratio": -0.015, "damping_ratio": 0.3}, 0.05),
        ({"frequency_ratio": 0.015, "damping_ratio": 0.3, "normal_amplitude": 1.2}, 0.05),
    ],
)
def test_a_slider_that_leaves_rest_beside_flight_moves_on(
    instantiate: Instantiate, device: dict[str, float], size: float
) -> None:
    """A decaying resonator releases it just before lift-off, or only rounding does as the contact
    touches down: no step is refused for the work of releases that end at once."""
    decaying = {"amplitude_deviation": -1.0, "initial_resonator_displacement": 1e-4}
    instance = instantiate().initialize(**{"normal_amplitude": 1.5, **decaying, **device})
    instance.run(25, size)
