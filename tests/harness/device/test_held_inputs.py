from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.device.held_inputs import HeldInputs, check_contiguous, check_times

HELD = [HeldInputs(0.0, 0.1), HeldInputs(0.1, 0.3, load=0.05)]


def test_adjoining_inputs_are_accepted() -> None:
    check_contiguous(HELD)


def test_empty_inputs_are_refused() -> None:
    with pytest.raises(ValueError, match="at least one"):
        check_contiguous([])


def test_gap_is_refused_with_both_times() -> None:
    with pytest.raises(ValueError, match=r"held inputs 1: start = 0\.2 s .* 0\.1 s"):
        check_contiguous([HeldInputs(0.0, 0.1), HeldInputs(0.2, 0.3)])


@pytest.mark.parametrize("stop", [0.0, -1.0, float("nan")])
def test_empty_interval_is_refused(stop: float) -> None:
    with pytest.raises(ValueError, match="held inputs 0: stop"):
        check_contiguous([HeldInputs(0.0, stop)])


def test_times_at_both_ends_and_no_times_are_accepted() -> None:
    check_times(np.array([0.0, 0.1, 0.1, 0.3]), HELD)
    check_times(np.empty(0), HELD)


def test_times_outside_the_inputs_are_refused() -> None:
    with pytest.raises(ValueError, match=r"to 0\.4 s must lie within .* 0\.0 to 0\.3 s"):
        check_times(np.array([0.1, 0.4]), HELD)


@pytest.mark.parametrize("times", [[0.2, 0.1], [[0.1], [0.2]], [0.1, float("nan")]])
def test_times_that_do_not_ascend_are_refused(times: list[float]) -> None:
    with pytest.raises(ValueError, match="ascending row"):
        check_times(np.array(times), HELD)
