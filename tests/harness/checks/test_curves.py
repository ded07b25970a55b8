from __future__ import annotations

from dataclasses import replace

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.curves import MAX_POINTS, Curves, curves_of, overview_of
from slider_resonator.checks.measures import no_tube
from slider_resonator.checks.measuring import Measurement
from tests.harness.verdicts import PASSED, SIGNAL


def judged(quantity: str, count: int, *, tube: bool = False) -> Curves:
    times = np.linspace(0.0, 1.0, count)
    reference: Array = 2.0 * times
    expected = no_tube(reference) if tube else reference
    check = replace(SIGNAL, quantity=quantity)
    found = curves_of(check, Measurement(times, times=times), expected)
    assert found is not None
    return found


def test_the_slowest_signal_is_shown_whatever_the_order() -> None:
    both = [judged("velocity", 9), judged("position", 9), judged("mean_velocity_in_run", 9)]
    for order in (both, both[::-1]):
        found = overview_of(order)
        assert found is not None
        assert found.check.quantity == "mean_velocity_in_run"
        assert found.check.scene == SIGNAL.scene
        assert np.array_equal(found.reference, 2.0 * found.fmu)


def test_a_long_slow_signal_is_thinned_over_the_whole_run() -> None:
    found = overview_of([judged("position", 10 * MAX_POINTS, tube=True)])
    assert found is not None
    assert len(found.times) == MAX_POINTS
    assert (found.times[0], found.times[-1]) == (0.0, 1.0)
    assert np.array_equal(found.times, found.fmu)


def test_of_a_long_fast_signal_the_end_is_shown_in_full() -> None:
    found = overview_of([judged("velocity", 10 * MAX_POINTS)])
    assert found is not None
    assert len(found.times) == MAX_POINTS
    assert found.times[-1] == 1.0
    assert np.ptp(np.diff(found.times)) < 1e-12
    assert found.times[0] > 0.89


def test_scenes_without_signals_have_none() -> None:
    assert overview_of([]) is None
    assert curves_of(PASSED, Measurement(0.1), 0.1) is None
    assert overview_of([judged("contact_mode", 9)]) is None
