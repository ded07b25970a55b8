from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import (
    RATES,
    HeldInputs,
    TunedInputs,
    check_contiguous,
    check_times,
    turning_apart,
    with_steady_phase,
)

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


LINE = HeldInputs(0.0, 0.2, 0.3, 0.1, 1.0, phase_rate=2.0, load_rate=-1.0, ratio_rate=0.5)


def test_a_line_goes_on_where_it_was() -> None:
    later = LINE.later(0.1)
    assert (later.start, later.stop) == (0.1, 0.2)
    assert (later.phase, later.load, later.frequency_ratio) == pytest.approx((0.5, 0.0, 1.05))
    assert later.later(0.05) == LINE.later(0.1).later(0.05)
    assert LINE.vary
    assert not HELD[0].vary
    assert LINE.turned(0.2, 10.0) == pytest.approx(10.0 * (0.2 + 0.25 * 0.04))


@pytest.mark.parametrize("rate", RATES)
def test_rates_are_refused_where_they_are_not_covered(rate: str) -> None:
    with pytest.raises(ValueError, match=f"held inputs 0: {rate} = .*: must be 0"):
        check_contiguous([LINE], rates=[name for name in RATES if name != rate])
    check_contiguous([LINE], rates=RATES)


def test_inputs_are_cut_where_the_load_turns_back() -> None:
    line = HeldInputs(1.0, 1.5, 0.3, 0.1, 0.4, load_rate=2.0, ratio_rate=-2.0)
    before, after = turning_apart([line])
    assert (before.start, before.stop, after.start, after.stop) == (1.0, 1.2, 1.2, 1.5)
    assert after.frequency_ratio == 0.0
    assert after.load == pytest.approx(0.5)
    unturned = [replace(line, stop=1.2), replace(line, frequency_ratio=0.0), *HELD]
    assert turning_apart(unturned) == unturned


def test_a_rate_of_the_phase_is_a_shift_of_the_ratio() -> None:
    rise = HeldInputs(0.0, 0.1, 0.3, phase_rate=7.0)
    jump = TunedInputs(0.1, 0.2, -0.5, phase_rate=3.0, tuned=(("drive_frequency", 3000.0),))
    first, second = with_steady_phase([rise, jump], Device())
    assert (first.phase, first.frequency_ratio, first.phase_rate) == (0.3, 1.0 + 0.002, 0.0)
    assert second.frequency_ratio == 1.0 + 0.001
    assert second.phase == pytest.approx(-0.5 - 0.7), "psi has gained what the ramp has added"
    assert with_steady_phase(HELD, Device()) == HELD
