"""The resolved reference against motions that have closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from tests.harness.references.known_motions import FIRST_SLIP, FREQUENCY, KNOWN_MOTIONS, STOP

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
    assert run.sticks == motion.sticks, f"{name}: number of sticks"
    assert run.reversals == 0, f"{name}: nothing here turns round"


def test_slider_breaks_loose_where_the_drive_exceeds_friction() -> None:
    times = np.linspace(0.0, 3.5 / FREQUENCY, 301)
    run = simulate(FIRST_SLIP.device, FIRST_SLIP.held, times)
    assert deviation(run, "velocity", FIRST_SLIP.exact(times)) <= ALLOWED
    assert run.event_times[0] == pytest.approx(FIRST_SLIP.event_times[0], rel=1e-13), (
        "0.4 sin(w t) N reaches 0.2 N of friction at w t = pi / 6"
    )
    assert run.contact_mode[np.searchsorted(times, run.event_times[0])] == 1


def test_stop_is_complete() -> None:
    motion = KNOWN_MOTIONS["constant friction slides to a stop and sticks"]
    run = simulate(motion.device, motion.held, TIMES)
    after = TIMES - 0.1 > 1e-10
    assert (run.velocity[after] == 0.0).all(), "a stuck slider has velocity 0 exactly"
    assert (run.contact_mode[after] == 0).all(), "after the stop it sticks"
    assert (run.friction_force[after] == 0.0).all(), "nothing pulls, so friction holds nothing"
    assert run.stick_time == pytest.approx(0.1, rel=1e-12), "it sticks for the other half"
