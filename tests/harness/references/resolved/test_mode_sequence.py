from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.mode_sequence import ModeSequence
from slider_resonator.references.resolved.segment import Follow, Segment, SegmentResult
from slider_resonator.references.resolved.trajectory import Trajectory

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


def test_sample_on_a_boundary_belongs_to_the_inputs_before() -> None:
    held = [HeldInputs(0.0, 1.0, load=0.1), HeldInputs(1.0, 2.0, load=0.15)]
    motion = run(BLOCK, held, [0.0, 0.5, 1.0, 1.0, 1.5, 2.0])
    expected = [-0.1, -0.1, -0.1, -0.1, -0.15, -0.15]
    assert motion.friction_force == pytest.approx(expected), "stuck friction balances the load"
    assert motion.time.shape == motion.contact_mode.shape == (6,)


def test_rest_is_reassessed_when_inputs_change() -> None:
    held = [HeldInputs(0.0, 1.0), HeldInputs(1.0, 2.0, load=0.5), HeldInputs(2.0, 3.0, load=-0.5)]
    motion = run(BLOCK, held, [0.5, 1.5, 2.5])
    assert motion.contact_mode.tolist() == [0, -1, 1], "friction holds 0.2 N, not 0.5 N"
    assert motion.event_times.tolist() == [1.0, 2.0]
    assert (motion.reversals, motion.sticks, motion.stick_time) == (1, 0, 1.0)


def test_slider_stops_and_sticks_if_friction_suffices() -> None:
    moving = Device(resonator_mass=0.0, base_amplitude=0.0, initial_velocity=0.3)
    motion = run(moving, [HeldInputs(0.0, 1.0)], [0.2, 0.4, 0.6], coast(event_at=0.5, event=-1))
    assert motion.velocity.tolist() == [0.3, 0.3, 0.0]
    assert motion.contact_mode.tolist() == [1, 1, 0]
    assert (motion.sticks, motion.reversals) == (1, 0)
    assert (motion.steps, motion.evaluations) == (2, 6), "the cost of both segments"


def test_slider_reverses_at_once_if_friction_does_not_suffice() -> None:
    moving = Device(
        resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0, initial_velocity=0.3
    )
    held = [HeldInputs(0.0, 0.8, load=0.5)]
    motion = run(moving, held, [0.6], coast(event_at=0.5, event=-1))
    assert motion.contact_mode.tolist() == [-1]
    assert (motion.sticks, motion.reversals) == (0, 1)


def test_flight_begins_and_ends_with_the_normal_load() -> None:
    device = Device(
        resonator_mass=0.0,
        base_amplitude=0.0,
        normal_preload=1.0,
        normal_amplitude=2.0,
        drive_frequency=1.0,
        initial_velocity=0.1,
    )
    motion = run(device, [HeldInputs(0.0, 7.0)], [3.0, 4.0, 5.0, 6.0])
    assert motion.contact_mode.tolist() == [1, 2, 2, 1]
    assert motion.event_times == pytest.approx([7.0 * np.pi / 6.0, 11.0 * np.pi / 6.0]), (
        "1 + 2 sin(t) vanishes there"
    )
    assert motion.normal_force[1:3].tolist() == [0.0, 0.0], "nothing pushes in flight"
    assert motion.reversals == 0, "it lands in the direction in which it took off"


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


def test_counts_do_not_depend_on_samples() -> None:
    held = [HeldInputs(0.0, 1.0), HeldInputs(1.0, 2.0, load=0.5)]
    motion = run(BLOCK, held, [])
    assert motion.position.shape == (0,)
    assert motion.event_times.tolist() == [1.0], "events after the last sample count as well"


def test_unresolvable_contact_is_an_error_with_its_time() -> None:
    def stuttering(segment: Segment) -> SegmentResult:
        return SegmentResult(0.0, segment.state, 1, np.empty((0, 4)), steps=1, evaluations=1)

    with pytest.raises(RuntimeError, match=r"contact at t = 0\.25 s"):
        run(BLOCK, [HeldInputs(0.25, 1.0)], [], stuttering)


def test_gaps_and_times_outside_are_refused() -> None:
    with pytest.raises(ValueError, match="held inputs 1"):
        run(BLOCK, [HeldInputs(0.0, 1.0), HeldInputs(1.5, 2.0)], [])
    with pytest.raises(ValueError, match="must lie within"):
        run(BLOCK, [HeldInputs(0.0, 1.0)], [1.5])
