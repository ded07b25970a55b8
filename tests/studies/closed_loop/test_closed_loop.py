"""The duty of the loop, its judge, and predicted errors."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.errors import HarnessError
from studies.closed_loop.duty import Duty
from studies.closed_loop.judge import judge_agreement, judge_interval
from studies.closed_loop.loop import HOSTS, LoopRecord, run_loop
from studies.closed_loop.prediction import predicted_errors
from tests.harness.faulty_fmus import reworded


def test_a_load_counts_from_its_own_time_on_despite_rounding() -> None:
    duty = Duty(loads=((0.0, 0.0), (0.3, 0.05)), end=1.0)
    assert [duty.load(time) for time in (0.0, 0.29)] == [0.0, 0.0]
    assert [duty.load(time) for time in (0.3 - 1e-12, 0.3, 0.1 + 0.1 + 0.1, 0.9)] == [0.05] * 4


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
    for interval in DUTY.intervals:
        held = judge_interval(record(decaying(5.0)), DUTY, interval)
        assert held.passed
        assert held.settled == pytest.approx(np.log(5.0) / 5.0, abs=0.01)
        assert held.largest == pytest.approx(0.1 * np.exp(-0.05))
        assert held.after_settling == pytest.approx(0.1 * np.exp(-2.5))


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


BRIEF_DUTY = Duty(loads=((0.0, 0.0), (0.8, 0.03)), end=1.6, settling=0.5)


PLACE = '<ssv:Parameter name="slider.fidelity">'
ORDER_1 = '<ssv:Parameter name="slider.averaging_order"><ssv:Integer value="1"/></ssv:Parameter>'


@pytest.mark.slow
def test_errors_are_of_the_order_of_the_averages(closed_loop_package: Path, tmp_path: Path) -> None:
    first = reworded(closed_loop_package, tmp_path / "first.ssp", PLACE, ORDER_1 + PLACE)
    per_radian, fast = 2.0 * 0.1 * 1.0 / (1.1 * 3500.0), 0.2366
    (error, made), (second, made_then) = (
        errors_of(package) for package in (first, closed_loop_package)
    )
    assert per_radian / 10.0 < error < 4.0 * per_radian
    assert error / 10.0 < made < 3.0 * error
    size = per_radian**2 / fast
    assert max(second, made_then) < 4.0 * size, "less while phases that keep changing are resolved"


def errors_of(package: Path) -> tuple[float, float]:
    """The predicted error (m/s) and the largest one made."""
    design, proof = run_loop(package, HOSTS[0], BRIEF_DUTY)
    shares: list[float] = []
    (error,) = predicted_errors(package, design, BRIEF_DUTY, shares.append)
    assert error is not None
    assert shares == [1.0]
    return error, np.abs(design.velocity - proof.velocity)[design.times > 0.81].max()


@pytest.mark.slow
def test_averaged_motion_that_does_not_do_has_no_error(
    closed_loop_package: Path, tmp_path: Path
) -> None:
    strict = replace(BRIEF_DUTY, band=1e-8)
    first = reworded(closed_loop_package, tmp_path / "first.ssp", PLACE, ORDER_1 + PLACE)
    design, _ = run_loop(first, HOSTS[0], strict)
    assert predicted_errors(first, design, strict) == [None]


def test_a_package_without_slider_is_refused(closed_loop_package: Path, tmp_path: Path) -> None:
    design, _ = run_loop(closed_loop_package, HOSTS[0], BRIEF_DUTY)
    other = reworded(closed_loop_package, tmp_path / "other.ssp", '"slider"', '"motor"')
    with pytest.raises(HarnessError, match="no component slider, only controller, motor"):
        predicted_errors(other, design, BRIEF_DUTY)
