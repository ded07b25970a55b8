from __future__ import annotations

import numpy as np
import pytest

from studies.closed_loop.duty import Duty
from studies.closed_loop.judge import judge_agreement, judge_intervals
from studies.closed_loop.loop import LoopRecord

DUTY = Duty(reference=0.1, loads=((0.0, 0.0), (1.0, 0.05)), end=2.0, settling=0.5, band=0.02)
TIMES = 0.01 * np.arange(1.0, 201.0)


def record(velocity: np.ndarray, fidelity: int = 0) -> LoopRecord:
    idle = np.zeros_like(TIMES)
    return LoopRecord("a host", fidelity, TIMES, velocity, idle, idle)


def decaying(rate: float) -> np.ndarray:
    """10 % too slow after each step, less by exp(-rate t) from then on."""
    since = np.where(TIMES <= 1.0 + 1e-9, TIMES, TIMES - 1.0)
    return np.asarray(0.1 * (1.0 - 0.1 * np.exp(-rate * since)))


def test_a_velocity_that_settles_in_time_is_held() -> None:
    for held in judge_intervals(record(decaying(5.0)), DUTY):
        assert held.passed
        assert held.settled == pytest.approx(np.log(5.0) / 5.0, abs=0.01)
        assert held.largest == pytest.approx(0.1 * np.exp(-0.05))
        assert held.after_settling == pytest.approx(0.1 * np.exp(-2.5))


def test_one_that_settles_too_late_is_not() -> None:
    for held in judge_intervals(record(decaying(3.0)), DUTY):
        assert not held.passed
        assert held.settled is not None
        assert held.settled > DUTY.settling


def test_a_single_point_outside_counts() -> None:
    velocity = np.full_like(TIMES, 0.1)
    velocity[np.searchsorted(TIMES, 1.9)] = 0.103
    first, second = judge_intervals(record(velocity), DUTY)
    assert (first.passed, second.passed) == (True, False)
    assert second.settled == pytest.approx(0.91, abs=0.011)


def test_a_velocity_that_never_settles_has_no_settling_time() -> None:
    held = judge_intervals(record(np.full_like(TIMES, 0.09)), DUTY)
    assert [entry.settled for entry in held] == [None, None]


def test_design_and_proof_are_compared_from_the_step_of_the_load_on() -> None:
    design = record(np.full_like(TIMES, 0.1))
    velocity = np.full_like(TIMES, 0.1)
    velocity[:99] = 0.0
    velocity[150] += 2e-4
    proof = record(velocity, 2)
    (found,) = judge_agreement(design, proof, DUTY, [3e-4])
    assert found.passed
    assert (found.start, found.load) == (1.0, 0.05)
    assert [found.difference, found.time] == pytest.approx([2e-4, 1.51])
    (found,) = judge_agreement(design, proof, DUTY, [1e-4])
    assert not found.passed


def test_no_prediction_for_averaged_motion_is_no_agreement() -> None:
    same = record(np.full_like(TIMES, 0.1))
    (found,) = judge_agreement(same, same, DUTY, [None])
    assert (found.difference, found.predicted, found.passed) == (0.0, None, False)
