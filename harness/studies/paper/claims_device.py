"""Statements of section 4: the device of table 1 and its variant with ten times the frequency."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi

from slider_resonator.checks.measures import ripple_amplitude
from slider_resonator.device.device import Device
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.device_average import blocking_force as average_force
from slider_resonator.references.equivalent_force import equivalent_force
from studies.paper.claim import Claim, ClaimGroup, claim, near
from studies.paper.measure import blocking_force, record, steady_motion
from studies.paper.slow_theory import strength_of

FAST = {"base_amplitude": 1e-5, "drive_frequency": 35000.0, "resonator_frequency": 35000.0}
RIPPLE_PERIODS = 8
POINTS_PER_PERIOD = 64


@dataclass(frozen=True)
class _Motion:
    velocity: float
    ripple: float
    force: float


def _motion(instance: Instance, values: dict[str, float]) -> _Motion:
    """Return steady velocity (m/s), ripple amplitude (m) and the force (N) that takes."""
    device = Device.from_mapping(values)
    velocity, state = steady_motion(instance, values)
    start = {f"initial_{name}": value for name, value in state.items()}
    period = 2.0 * pi / device.drive_frequency
    points = RIPPLE_PERIODS * POINTS_PER_PERIOD
    run = record(instance, {**values, **start}, RIPPLE_PERIODS * period, points)
    ripple = ripple_amplitude(run.times, run["position"], period)
    return _Motion(velocity, ripple, ripple * device.total_mass * device.drive_frequency**2)


def _measure(instance: Instance) -> Iterator[Claim]:
    table, fast = _motion(instance, {}), _motion(instance, FAST)
    slow_device, fast_device = Device(), Device.from_mapping(FAST)
    force, fast_force = equivalent_force(slow_device), equivalent_force(fast_device)
    strength, fast_strength = strength_of(slow_device), strength_of(fast_device)
    blocking = blocking_force(instance, {})
    theory = average_force(Device(), 0.0, 1.0)
    yield claim(
        "equivalent_force",
        near(force.amplitude, 910.95, 1e-5)
        and near(force.angle, 0.733, 1e-3)
        and near(strength, 1.301, 1e-3)
        and near(table.force, 910.95, 2e-3),
        {
            "amplitude_N": force.amplitude,
            "phase_rad": force.angle,
            "strength": strength,
            "fmu_force_from_ripple_N": table.force,
        },
    )
    steady = near(table.velocity, 0.126667, 1e-4)
    yield claim("steady_velocity", steady, {"fmu_m_per_s": table.velocity})
    yield claim(
        "ripple",
        near(table.ripple, 67.6e-6, 2e-3),
        {"fmu_um": 1e6 * table.ripple, "theory_um": 1e6 * force.ripple_amplitude},
    )
    yield claim(
        "fast_ripple",
        near(fast.ripple, 6.76e-6, 2e-3),
        {
            "fmu_um": 1e6 * fast.ripple,
            "theory_um": 1e6 * fast_force.ripple_amplitude,
            "resonator_hertz": FAST["resonator_frequency"] / (2.0 * pi),
        },
    )
    yield claim(
        "fast_velocity",
        near(fast_strength, strength, 1e-9) and near(fast.velocity, table.velocity, 2e-3),
        {"strength": fast_strength, "phase_rad": fast_force.angle, "fmu_m_per_s": fast.velocity},
    )
    yield claim(
        "fast_force",
        near(fast_force.amplitude, 9109.5, 1e-5) and near(fast.force, 9109.5, 2e-3),
        {"amplitude_N": fast_force.amplitude, "fmu_force_from_ripple_N": fast.force},
    )
    yield claim(
        "dimensional_blocking_force",
        near(blocking, theory, 2e-3),
        {"fmu_N": blocking, "one_face_N": 0.5 * theory, "both_faces_N": theory},
    )


GROUP = ClaimGroup("claims_device", "The device of table 1", (_measure,))
