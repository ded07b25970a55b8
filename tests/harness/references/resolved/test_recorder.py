from __future__ import annotations

import numpy as np

from slider_resonator.references.resolved.contact import LIFTED, SLIP_BACKWARD, SLIP_FORWARD, STICK
from slider_resonator.references.resolved.recorder import Recorder


def record_of(*modes: int) -> Recorder:
    record = Recorder(np.empty(0))
    for index, mode in enumerate(modes):
        record.enter(mode, float(index))
    return record


def test_first_mode_is_no_event() -> None:
    record = record_of(STICK)
    assert (record.sticks, record.trajectory().reversals, record.event_times) == (0, 0, [])


def test_sliding_on_in_the_same_direction_is_no_reversal() -> None:
    assert (
        record_of(STICK, SLIP_FORWARD, STICK, SLIP_FORWARD, LIFTED, SLIP_FORWARD)
        .trajectory()
        .reversals
        == 0
    )


def test_reversal_counts_directly_and_after_stick_or_flight() -> None:
    assert record_of(SLIP_FORWARD, SLIP_BACKWARD).trajectory().reversals == 1
    assert record_of(SLIP_FORWARD, STICK, SLIP_BACKWARD).trajectory().reversals == 1
    assert record_of(SLIP_BACKWARD, LIFTED, STICK, SLIP_FORWARD).trajectory().reversals == 1


def test_only_mode_changes_are_counted() -> None:
    record = record_of(SLIP_FORWARD, STICK, STICK, LIFTED, STICK)
    assert record.sticks == 2, "re-entering the present mode is no new stick"
    assert record.event_times == [1.0, 3.0, 4.0]


def test_stick_time_adds_up_in_stick_only() -> None:
    record = record_of(STICK)
    record.stay(0.5)
    record.enter(SLIP_FORWARD, 0.5)
    record.stay(2.0)
    record.enter(STICK, 2.5)
    record.stay(0.25)
    assert record.stick_time == 0.75


def test_modes_and_reversals_have_their_times() -> None:
    record = record_of(SLIP_FORWARD, LIFTED, SLIP_BACKWARD, STICK)
    assert record.modes == [SLIP_FORWARD, LIFTED, SLIP_BACKWARD, STICK]
    assert record.reversal_times == [2.0]
    record.slide(SLIP_FORWARD)
    assert record.trajectory().reversals == 2, "a reversal without a time counts"
