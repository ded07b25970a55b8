from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.averaged.averaged_outputs import AveragedOutputs, averaged_outputs
from slider_resonator.references.resolved.simulate import simulate

PERIOD = 2.0 * np.pi / 3500.0
DEVICE = Device(fidelity=0, normal_amplitude=1.3)
HELD = [
    HeldInputs(0.0, 20.3 * PERIOD, phase=0.4),
    HeldInputs(20.3 * PERIOD, 40.0 * PERIOD, phase=2.0, load=0.02, frequency_ratio=2.0),
]
TIMES = np.linspace(0.0, 40.0 * PERIOD, 4001)


def outputs_of(device: Device, held: list[HeldInputs] = HELD) -> AveragedOutputs:
    return averaged_outputs(device, held, simulate_averaged(device, held, TIMES))


def test_the_normal_load_is_that_of_resolved_motion() -> None:
    resolved = simulate(replace(DEVICE, fidelity=2), HELD, TIMES)
    found = outputs_of(DEVICE)
    assert found.normal_force == pytest.approx(resolved.normal_force, abs=1e-9)
    assert ((found.contact_mode == 2) == (resolved.contact_mode == 2)).mean() > 0.999


def test_the_resonator_swings_as_a_damped_one_does_in_the_end() -> None:
    weak = replace(DEVICE, friction_coefficient=1e-9)
    resolved = simulate(replace(weak, fidelity=2), HELD, TIMES)
    found, late = outputs_of(weak), slice(3500, None)
    for name in ("resonator_displacement", "resonator_velocity"):
        expected = getattr(resolved, name)[late]
        assert getattr(found, name)[late] == pytest.approx(expected, abs=3e-4 * expected.max())


@pytest.mark.parametrize("law", [0, 1])
def test_friction_and_load_are_the_rate_of_momentum(law: int) -> None:
    device = replace(DEVICE, friction_law=law, friction_faces=1)
    held = HELD[:1]
    times = np.linspace(0.0, held[0].stop, 201)
    motion = simulate_averaged(device, held, times)
    friction = averaged_outputs(device, held, motion).friction_force
    impulse = np.sum(0.5 * (friction[1:] + friction[:-1]) * np.diff(times))
    change = motion.mean_velocity[-1] - motion.mean_velocity[0]
    assert device.total_mass * change == pytest.approx(-impulse, rel=1e-4)


def test_a_block_is_held_by_what_the_load_needs() -> None:
    block = replace(DEVICE, base_amplitude=0.0, normal_amplitude=0.5)
    held = [HeldInputs(0.0, HELD[-1].stop, load=0.07)]
    assert outputs_of(block, held).friction_force == pytest.approx(np.full(4001, -0.07))
    sliding = replace(block, initial_velocity=-1.0)
    assert outputs_of(sliding, held).friction_force == pytest.approx(np.full(4001, -0.2))
