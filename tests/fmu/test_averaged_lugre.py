"""First-order averages of LuGre friction in the FMU against resolved motion, soft to hard bristles.

The device is model 2 of the paper with q = 1, mu = 0.4, sigma_1 = 1 in its own units, so that fast
velocity and preload are 1; kappa = sigma_0 q / (mu Omega).
"""

from __future__ import annotations

import pytest

from slider_resonator.device.device import Device
from slider_resonator.references.resolved.lugre_taylor import simulate_lugre
from slider_resonator.steady.reference_steady import (
    reference_blocking_force,
    reference_steady_velocity,
)
from tests.fmu.host import Instantiate

KAPPAS = (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)
SLOW = pytest.mark.slow
PHASE = 1.0
FRICTION = 0.4


def parameters(kappa: float, frequency: float, amplitude_ratio: float = 0.8) -> dict[str, float]:
    return {
        "slider_mass": 1.0,
        "resonator_mass": 0.0,
        "base_amplitude": 0.0,
        "tangential_force": frequency,
        "drive_frequency": frequency,
        "normal_amplitude": amplitude_ratio,
        "friction_coefficient": FRICTION,
        "friction_faces": 1,
        "friction_law": 1,
        "averaging_order": 1,
        "bristle_stiffness": kappa * FRICTION * frequency,
        "bristle_damping": 1.0,
    }


@pytest.mark.parametrize("amplitude_ratio", [0.8, 1.6], ids=["closed", "lifting"])
@pytest.mark.parametrize("kappa", [1.0, *(pytest.param(k, marks=SLOW) for k in KAPPAS if k != 1.0)])
def test_predictions_err_by_the_inverse_frequency(
    instantiate: Instantiate, kappa: float, amplitude_ratio: float
) -> None:
    """Against the motion that repeats each period, found by shooting with the reference."""
    errors = []
    for frequency in (1000.0, 4000.0):
        values = parameters(kappa, frequency, amplitude_ratio)
        instance = instantiate().initialize(**values, phase=PHASE)
        velocity, force = instance.get("steady_velocity", "blocking_force")
        device = Device.from_mapping({**values, "fidelity": 1})
        steady = reference_steady_velocity(
            device, PHASE, 0.0, 1.0, velocity, simulate=simulate_lugre
        )
        blocking = reference_blocking_force(device, PHASE, 1.0, force, simulate=simulate_lugre)
        assert steady is not None, "the resolved device has a steady motion"
        assert blocking is not None, "a load stops the resolved device"
        errors.append((velocity - steady, force - blocking))
    for quantity, coarse, fine in zip(("velocity", "blocking"), *errors, strict=True):
        assert abs(coarse) <= 2e-3, f"{quantity} at Omega = 1000, in units of v_q and N0"
        assert coarse / fine == pytest.approx(4.0, rel=0.05), f"{quantity}: slope 1 in 1 / Omega"


@pytest.mark.parametrize("kappa", KAPPAS)
def test_averaged_motion_settles_at_the_prediction(instantiate: Instantiate, kappa: float) -> None:
    values = parameters(kappa, 1000.0)
    instance = instantiate().initialize(**values, phase=PHASE, fidelity=0)
    instance.step(200.0)
    mean, steady = instance.get("mean_velocity", "steady_velocity")
    assert mean == pytest.approx(steady, abs=1e-6), "averaged motion and averaged theory are one"
    device = Device.from_mapping({**values, "fidelity": 1})
    direct = reference_steady_velocity(device, PHASE, 0.0, 1.0, steady, simulate=simulate_lugre)
    assert mean == pytest.approx(direct, abs=2e-3), "within 2e-3 of v_q of the resolved motion"
