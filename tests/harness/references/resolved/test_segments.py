"""What a resolved trajectory is made of: contact modes, their sequence and located roots."""

import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import (
    LIFTED,
    SLIP_BACKWARD,
    SLIP_FORWARD,
    STICK,
    is_lifted,
    time_to_contact_change,
)
from slider_resonator.references.resolved.mode_sequence import ModeSequence
from slider_resonator.references.resolved.polynomial_roots import first_fall
from slider_resonator.references.resolved.recorder import Recorder
from slider_resonator.references.resolved.segment import Follow, Segment, SegmentResult
from slider_resonator.references.resolved.trajectory import Trajectory


@pytest.mark.parametrize("rate", [3500.0, -3500.0, 0.5])
@pytest.mark.parametrize("amplitude", [1.0 + 1e-9, 1.5, 40.0])
@pytest.mark.parametrize("angle", [-3.0, 0.0, 1.0, 3.5, 5.0, 100.0])
def test_contact_changes_where_the_normal_load_crosses_zero(
    rate: float, amplitude: float, angle: float
) -> None:
    for lifted in (False, True):
        time = time_to_contact_change(lifted, 1.0, amplitude, angle, rate)
        assert 0.0 <= time <= 2.0 * math.pi / abs(rate), "it happens once in every period"
        load = 1.0 + amplitude * math.sin(angle + rate * time)
        assert load == pytest.approx(0.0, abs=1e-12 * amplitude), "there the load vanishes"
        slope = amplitude * rate * math.cos(angle + rate * time)
        assert (slope < 0.0) == (not lifted), "lift-off where it falls, touchdown where it rises"


@pytest.mark.parametrize("rate", [1.0, -1.0])
def test_contact_at_a_crossing_is_the_one_just_after(rate: float) -> None:
    assert is_lifted(0.0, 1.0, math.pi, 1.0), "at lift-off it has lifted"
    assert not is_lifted(0.0, 1.0, 2.0 * math.pi, 1.0), "at touchdown it has touched down"
    assert time_to_contact_change(False, 1.0, 1.0, -math.pi / 2.0, rate) == math.inf
    assert not is_lifted(1.0, 1.0, -math.pi / 2.0, rate), "touching is not lifting"


def test_constant_normal_load_never_changes_the_contact() -> None:
    assert time_to_contact_change(False, 1.0, 2.0, 0.0, 0.0) == math.inf
    assert time_to_contact_change(True, 1.0, 2.0, -1.5, 0.0) == math.inf
    assert is_lifted(1.0, 2.0, -1.5, 0.0), "1 + 2 sin(-1.5) < 0: open for good"
    assert not is_lifted(1.0, 2.0, 0.0, 0.0)
    assert is_lifted(0.0, 0.0, 0.3, 1.0), "without any normal load there is no contact"


def record_of(*modes: int) -> Recorder:
    record = Recorder(np.empty(0))
    for index, mode in enumerate(modes):
        record.enter(mode, float(index))
    return record


def test_reversal_counts_directly_and_after_stick_or_flight() -> None:
    assert record_of(SLIP_FORWARD, SLIP_BACKWARD).trajectory().reversals == 1
    assert record_of(SLIP_FORWARD, STICK, SLIP_BACKWARD).trajectory().reversals == 1
    assert record_of(SLIP_BACKWARD, LIFTED, STICK, SLIP_FORWARD).trajectory().reversals == 1


def test_modes_and_reversals_have_their_times() -> None:
    record = record_of(SLIP_FORWARD, LIFTED, SLIP_BACKWARD, STICK)
    assert record.modes == [SLIP_FORWARD, LIFTED, SLIP_BACKWARD, STICK]
    assert record.reversal_times == [2.0]
    record.slide(SLIP_FORWARD)
    assert record.trajectory().reversals == 2, "a reversal without a time counts"


BLOCK = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)


def coast(event_at: float = np.inf, event: int = 0) -> Follow:
    """A stand-in integrator: uniform motion, with one event after a given time of slip."""

    def follow(segment: Segment) -> SegmentResult:
        happens = segment.mode != 0 and event_at < segment.span
        duration = event_at if happens else segment.span
        position, velocity, *resonator = segment.state
        times = segment.samples[segment.samples <= duration]
        samples = np.tile(segment.state, (len(times), 1))
        samples[:, 0] += velocity * times
        state = (position + velocity * duration, velocity, resonator[0], resonator[1])
        return SegmentResult(
            duration, state, event if happens else 0, samples, steps=1, evaluations=3
        )

    return follow


def run(
    device: Device, held: list[HeldInputs], times: list[float], follow: Follow | None = None
) -> Trajectory:
    return ModeSequence(device, follow or coast(), np.array(times)).run(held)


def test_rest_is_reassessed_when_inputs_change() -> None:
    held = [HeldInputs(0.0, 1.0), HeldInputs(1.0, 2.0, load=0.5), HeldInputs(2.0, 3.0, load=-0.5)]
    motion = run(BLOCK, held, [0.5, 1.5, 2.5])
    assert motion.contact_mode.tolist() == [0, -1, 1], "friction holds 0.2 N, not 0.5 N"
    assert motion.event_times.tolist() == [1.0, 2.0]
    assert motion.modes.tolist() == [STICK, SLIP_BACKWARD, SLIP_FORWARD]
    assert motion.reversals == 1


def test_phase_change_jumps_and_ratio_change_does_not() -> None:
    device = Device(resonator_mass=0.0, base_amplitude=0.0, drive_frequency=1.0)
    held = [
        HeldInputs(0.0, 1.0, frequency_ratio=2.0),
        HeldInputs(1.0, 2.0, frequency_ratio=-0.5),
        HeldInputs(2.0, 3.0, frequency_ratio=-0.5, phase=0.8),
    ]
    motion = run(device, held, [1.0, 2.0, 3.0])
    angles = np.array([2.0, 2.0 - 0.5, 2.0 - 1.0 + 0.8])
    assert motion.normal_force == pytest.approx(1.0 + np.sin(angles)), "psi accumulates"


def test_unresolvable_contact_is_an_error_with_its_time() -> None:
    def stuttering(segment: Segment) -> SegmentResult:
        return SegmentResult(0.0, segment.state, 1, np.empty((0, 4)), steps=1, evaluations=1)

    with pytest.raises(RuntimeError, match=r"contact at t = 0\.25 s"):
        run(BLOCK, [HeldInputs(0.25, 1.0)], [], stuttering)


NOISE = 1e-15


def fall(polynomial: Polynomial, stop: float = 1.0) -> float | None:
    terms = polynomial.coef.astype(np.float64) * stop ** np.arange(len(polynomial.coef))
    share = first_fall(terms, NOISE)
    return None if share is None else share * stop


def test_first_of_several_roots_is_found() -> None:
    polynomial = -Polynomial.fromroots([0.3, 0.5, 0.7])
    assert fall(polynomial) == pytest.approx(0.3, rel=1e-14), "it falls at 0.3 and again at 0.7"
    rising_first = Polynomial.fromroots([-0.1, 0.3, 0.7])
    assert rising_first(0.0) > 0.0
    assert fall(rising_first) == pytest.approx(0.3, rel=1e-14)


@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-6])
def test_twin_roots_are_not_stepped_over(gap: float) -> None:
    twins = Polynomial.fromroots([0.37, 0.37 + gap])
    assert fall(twins) == pytest.approx(0.37, abs=1e-15 / gap)


def test_near_miss_is_no_root() -> None:
    near_miss = Polynomial.fromroots([0.37, 0.37]) + 1e-9
    assert fall(near_miss) is None
    assert fall(Polynomial([0.0, 0.0, 0.0])) is None, "identically zero does not fall"


def test_roots_beyond_the_interval_are_not_reported() -> None:
    assert fall(Polynomial([1.0, -1.0]), stop=0.999) is None
    assert fall(Polynomial([2.0, -1.0]), stop=4.0) == pytest.approx(2.0), "the interval is scaled"


@pytest.mark.parametrize("order", [1, 2])
def test_root_at_the_start_counts_only_if_the_polynomial_falls(order: int) -> None:
    start = Polynomial.fromroots([0.0] * order)
    assert fall(start * Polynomial([1.0, -2.0])) == pytest.approx(0.5), "rises, falls at 0.5"
    assert fall(-start) == 0.0, "falls at once"
    rounded = start * Polynomial([1.0, -2.0]) - 1e-17
    assert fall(rounded) == pytest.approx(0.5), "a start below zero by rounding is a root there"


def test_random_polynomials_agree_with_a_fine_grid() -> None:
    random = np.random.default_rng(1)
    grid = np.linspace(0.0, 1.0, 20_001)
    for _ in range(200):
        coefficients = random.normal(size=23) * 2.0 ** np.arange(23)
        coefficients[0] = abs(coefficients[0])
        below = np.flatnonzero(Polynomial(coefficients)(grid) < 0.0)
        found = first_fall(coefficients, NOISE * 2.0**23)
        if below.size:
            assert found is not None
            assert grid[below[0] - 1] - 1e-9 <= found <= grid[below[0]], "the first on the grid"
        elif found is not None:
            assert Polynomial(coefficients)(found) == pytest.approx(0.0, abs=1e-6)


def test_times_outside_are_refused() -> None:
    with pytest.raises(ValueError, match="must lie within"):
        run(BLOCK, [HeldInputs(0.0, 1.0)], [1.5])
