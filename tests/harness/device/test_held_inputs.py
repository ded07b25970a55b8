from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.device.held_inputs import HeldInputs, check_contiguous, check_times

HELD = [HeldInputs(0.0, 0.1), HeldInputs(0.1, 0.3, load=0.05)]


@pytest.mark.parametrize(
    ("held", "message"),
    [
        ([], "at least one"),
        ([HeldInputs(0.0, 0.1), HeldInputs(0.2, 0.3)], r"inputs 1: start = 0\.2 s .* 0\.1 s"),
        ([HeldInputs(0.0, 0.0)], "held inputs 0: stop"),
        ([HeldInputs(0.0, -1.0)], "held inputs 0: stop"),
        ([HeldInputs(0.0, float("nan"))], "held inputs 0: stop"),
    ],
)
def test_gaps_and_empty_intervals_are_refused(held: list[HeldInputs], message: str) -> None:
    check_contiguous(HELD)
    with pytest.raises(ValueError, match=message):
        check_contiguous(held)


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ([0.1, 0.4], r"to 0\.4 s must lie within .* 0\.0 to 0\.3 s"),
        ([0.2, 0.1], "ascending row"),
        ([[0.1], [0.2]], "ascending row"),
        ([0.1, float("nan")], "ascending row"),
    ],
)
def test_times_outside_or_out_of_order_are_refused(times: list[float], message: str) -> None:
    check_times(np.array([0.0, 0.1, 0.1, 0.3]), HELD)
    check_times(np.empty(0), HELD)
    with pytest.raises(ValueError, match=message):
        check_times(np.array(times), HELD)
