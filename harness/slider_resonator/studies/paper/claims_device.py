"""Statements of section 4: the device of table 1 and its variant with ten times the frequency."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from slider_resonator.checks.measures.ripple import ripple_amplitude
from slider_resonator.device.device import Device
from slider_resonator.device.schedule import schedule
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.references.closed_forms import device_blocking_force, equivalent_force
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.steady_velocity import find_steady
from slider_resonator.studies.paper.claim import AGREES, PARTLY, Claim, ClaimGroup, near

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
    steady = find_steady(instance, values)
    if steady.steady_velocity is None:
        raise FmuError(f"{instance.fmu.path.name}: {values}: {steady.reason}")
    start = {f"initial_{name}": value for name, value in steady.state.items()}
    period = 2.0 * pi / device.drive_frequency
    record = run(
        instance,
        {**values, **start},
        schedule(RIPPLE_PERIODS * period, period / POINTS_PER_PERIOD),
        outputs=("position",),
    )
    ripple = ripple_amplitude(record.times, record["position"], period)
    force = ripple * device.total_mass * device.drive_frequency**2
    return _Motion(steady.steady_velocity, ripple, force)


def _measure(instance: Instance) -> list[Claim]:
    table, fast = _motion(instance, {}), _motion(instance, FAST)
    force, fast_force = equivalent_force(Device()), equivalent_force(Device.from_mapping(FAST))
    blocking = find_blocking(instance, {}).blocking_force or float("nan")
    theory = device_blocking_force(Device(), 0.0)
    return [
        Claim(
            "equivalent_force",
            "section 4",
            "Table 1 is equivalent to 910.95 N at phase 0.733, so q = 1.301",
            {
                "amplitude_N": force.amplitude,
                "phase_rad": force.angle,
                "strength": force.strength,
                "fmu_force_from_ripple_N": table.force,
            },
            AGREES,
            "(32)-(34) with table 1; the FMU's ripple takes the same force",
            near(force.amplitude, 910.95, 1e-5)
            and near(force.angle, 0.733, 1e-3)
            and near(force.strength, 1.301, 1e-3)
            and near(table.force, 910.95, 2e-3),
        ),
        Claim(
            "steady_velocity",
            "section 4",
            "The slider of table 1 moves at 0.12 m/s, by (5) and by simulating (26)-(27)",
            {"fmu_m_per_s": table.velocity},
            AGREES,
            "(5) gives 0.12673 m/s, the full device 0.12667 m/s: 0.12 is cut, not rounded",
            near(table.velocity, 0.126667, 1e-4),
        ),
        Claim(
            "ripple",
            "section 4",
            "The fast oscillation of table 1 has an amplitude of 67.6 um",
            {"fmu_um": 1e6 * table.ripple, "theory_um": 1e6 * force.ripple_amplitude},
            AGREES,
            "F_T* / ((M + m) w^2); friction adds a component at the drive frequency in the FMU",
            near(table.ripple, 67.6e-6, 2e-3),
        ),
        Claim(
            "fast_ripple",
            "section 4",
            "10 um at 35 000 rad/s on a resonator of 5570.42 Hz bring it down to 6.76 um",
            {
                "fmu_um": 1e6 * fast.ripple,
                "theory_um": 1e6 * fast_force.ripple_amplitude,
                "resonator_hertz": FAST["resonator_frequency"] / (2.0 * pi),
            },
            AGREES,
            "the ripple is q / Omega, q is kept",
            near(fast.ripple, 6.76e-6, 2e-3),
        ),
        Claim(
            "fast_velocity",
            "section 4",
            "The variant keeps q, phase and so the velocity",
            {
                "strength": fast_force.strength,
                "phase_rad": fast_force.angle,
                "fmu_m_per_s": fast.velocity,
            },
            AGREES,
            "the averages depend on q, alpha and phase only; the rest is of order 1 / Omega",
            near(fast_force.strength, force.strength, 1e-9)
            and near(fast.velocity, table.velocity, 2e-3),
        ),
        Claim(
            "fast_force",
            "section 4",
            "The price is a force of 9109.5 N",
            {"amplitude_N": fast_force.amplitude, "fmu_force_from_ripple_N": fast.force},
            AGREES,
            "F_T* = q Omega: ten times as much",
            near(fast_force.amplitude, 9109.5, 1e-5) and near(fast.force, 9109.5, 2e-3),
        ),
        Claim(
            "dimensional_blocking_force",
            "(22)",
            "The blocking force is (2 / pi) mu dN sin(phi)",
            {
                "fmu_N": blocking,
                "one_face_N": 0.5 * theory,
                "both_faces_N": theory,
            },
            PARTLY,
            "(22) is for one face, the device of fig. 6 has two and blocks at twice as much",
            near(blocking, theory, 2e-3),
        ),
    ]


GROUP = ClaimGroup(
    "claims_device",
    "The device of table 1",
    (_measure,),
)
