import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.references.averaged import device_average
from slider_resonator.steady.reference_steady import (
    reference_blocking_force,
    reference_steady_velocity,
)

TABLE_1 = Device()


@pytest.mark.slow
def test_what_never_repeats_has_no_steady_motion() -> None:
    assert reference_steady_velocity(TABLE_1, 0.0, 0.0, 1.001) is None
    assert reference_blocking_force(TABLE_1, 0.0, 1.001) is None
    for device, load in ((TABLE_1, 0.25), (Device(friction_law=1), 3.0)):
        found = reference_steady_velocity(device, 0.0, load, 1.0)
        assert found is None, "a load above friction"


QUICK = (0.1, 10.0)
KAPPAS = [
    pytest.param(kappa, marks=() if kappa in QUICK else pytest.mark.slow)
    for kappa in (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)
]


def unit_device(kappa: float, frequency: float, amplitude_ratio: float) -> Device:
    """Model 2 of the paper with q = 1, mu = 0.4, sigma_1 = 1 at a stiffness number kappa.

    In its units x0 = 1 m, w0 = 1 rad/s: one mass, driven directly, on one face.
    """
    friction = 0.4
    return Device(
        slider_mass=1.0,
        resonator_mass=0.0,
        base_amplitude=0.0,
        tangential_force=frequency,
        drive_frequency=frequency,
        normal_amplitude=amplitude_ratio,
        friction_coefficient=friction,
        friction_faces=1,
        friction_law=1,
        bristle_stiffness=kappa * friction * frequency,
        bristle_damping=1.0,
        fidelity=1,
    )


@pytest.mark.parametrize("amplitude_ratio", [0.8, 1.6])
@pytest.mark.parametrize("kappa", KAPPAS)
def test_errors_of_averages_fall_with_the_frequency(kappa: float, amplitude_ratio: float) -> None:
    """Soft to hard bristles, closed and lifting: velocity and blocking force."""
    errors = []
    for frequency in (1000.0, 4000.0):
        device = unit_device(kappa, frequency, amplitude_ratio)
        averages = (
            device_average.steady_velocity(device, 1.0, 0.0, 1.0),
            device_average.blocking_force(device, 1.0, 1.0),
        )
        exact = (
            reference_steady_velocity(device, 1.0, 0.0, 1.0, averages[0]),
            reference_blocking_force(device, 1.0, 1.0),
        )
        errors.append(np.subtract(averages, np.array(exact, dtype=float)))
    for coarse, fine in zip(*errors, strict=True):
        assert abs(coarse) < 2e-3, "of v_q, or of N0"
        assert coarse / fine == pytest.approx(4.0, rel=0.02), "averages err by 1 / Omega"
