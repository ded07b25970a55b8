from __future__ import annotations

from studies.closed_loop.duty import Duty, LoadInterval


def test_a_load_counts_from_its_own_time_on_despite_rounding() -> None:
    duty = Duty(loads=((0.0, 0.0), (0.3, 0.05)), end=1.0)
    assert 0.1 + 0.1 + 0.1 != 0.3
    assert [duty.load(time) for time in (0.0, 0.29, 0.3, 0.1 + 0.1 + 0.1, 0.9)] == [
        *(0.0, 0.0),
        *(0.05, 0.05, 0.05),
    ]
    assert duty.load(0.3 - 1e-12) == 0.05


def test_holds_follow_one_another_to_the_end() -> None:
    duty = Duty(loads=((0.0, 0.0), (0.3, 0.05)), end=1.0)
    assert duty.intervals == [LoadInterval(0.0, 0.3, 0.0), LoadInterval(0.3, 1.0, 0.05)]
    assert len(duty.times) == 100
