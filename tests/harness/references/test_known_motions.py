"""Every integrator against motions that have closed forms."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from slider_resonator.references.resolved import located_events, taylor
from slider_resonator.references.resolved.trajectory import Trajectory
from tests.harness.references.known_motions import FIRST_SLIP, FREQUENCY, KNOWN_MOTIONS, STOP

Simulate = Callable[..., Trajectory]

# Allowed deviation in fractions of the peak: what each method has been measured to keep, rounded.
INTEGRATORS = {
    "taylor": (taylor.simulate, 2e-13),
    "located_events": (located_events.simulate, 1e-10),
}
TIMES = np.linspace(0.0, STOP, 701)

by_integrator = pytest.mark.parametrize(
    ("simulate", "allowed"), INTEGRATORS.values(), ids=INTEGRATORS
)


def deviation(run: Trajectory, signal: str, exact: np.ndarray) -> float:
    return float(np.abs(getattr(run, signal) - exact).max() / np.abs(exact).max())


@by_integrator
@pytest.mark.parametrize("name", KNOWN_MOTIONS)
def test_motion_matches_the_closed_form(simulate: Simulate, allowed: float, name: str) -> None:
    motion = KNOWN_MOTIONS[name]
    run = simulate(motion.device, motion.held, TIMES)
    found = deviation(run, motion.signal, motion.exact(TIMES))
    assert found <= allowed, f"{name}: {motion.signal} deviates by {found:.1e} of its peak"
    assert run.event_times == pytest.approx(motion.event_times, rel=1e-12), (
        f"{name}: instants of the changes of contact mode"
    )
    assert run.sticks == motion.sticks, f"{name}: number of sticks"
    assert run.reversals == 0, f"{name}: nothing here turns round"


@by_integrator
def test_slider_breaks_loose_where_the_drive_exceeds_friction(
    simulate: Simulate, allowed: float
) -> None:
    times = np.linspace(0.0, 3.5 / FREQUENCY, 301)
    run = simulate(FIRST_SLIP.device, FIRST_SLIP.held, times)
    assert deviation(run, "velocity", FIRST_SLIP.exact(times)) <= allowed
    assert run.event_times[0] == pytest.approx(FIRST_SLIP.event_times[0], rel=1e-13), (
        "0.4 sin(w t) N reaches 0.2 N of friction at w t = pi / 6"
    )
    assert run.contact_mode[np.searchsorted(times, run.event_times[0])] == 1


@by_integrator
def test_stop_is_complete(simulate: Simulate, allowed: float) -> None:
    motion = KNOWN_MOTIONS["constant friction slides to a stop and sticks"]
    run = simulate(motion.device, motion.held, TIMES)
    after = TIMES - 0.1 > 1e-10
    assert (run.velocity[after] == 0.0).all(), "a stuck slider has velocity 0 exactly"
    assert (run.contact_mode[after] == 0).all(), "after the stop it sticks"
    assert (run.friction_force[after] == 0.0).all(), "nothing pulls, so friction holds nothing"
    assert run.stick_time == pytest.approx(0.1, rel=1e-12), "it sticks for the other half"
