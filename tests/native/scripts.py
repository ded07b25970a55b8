"""Scripts for the C driver: ordinary devices and extreme ones."""

import math
from collections.abc import Mapping, Sequence

from fmu_src.python.slider_component.variables import VALUE_REFERENCE, VARIABLES
from tests.problems import PROBLEMS

GET = " ".join(["get", *(str(VALUE_REFERENCE[v.name]) for v in VARIABLES if v.start is None)])
CHOICES = [(law, fidelity) for law in (0, 1) for fidelity in (2, 1, 0)]
STEPS = ((1e-3, 10), (7.3e-5, 30), (0.01, 1), (1e-12, 3))
"""Size [s] and number."""

EXTREMES: dict[str, Sequence[float]] = {
    "slider_mass": (1e-6, 1e6),
    "resonator_mass": (0.0, 1e-12, 1e6),
    "resonator_frequency": (1e-6, 1.0, 1e6),
    "damping_ratio": (0.0, 1e-12, 1.0, 100.0),
    "normal_preload": (0.0, 1e-300, 1e4),
    "normal_amplitude": (0.0, math.nextafter(1.0, 2.0), 100.0, 1e4),
    "base_amplitude": (0.0, 5e-324, 1e-9, 1.0, 1e300),
    "drive_frequency": (1e-6, 1.0, 1e5, 1e300),
    "tangential_force": (-3.0, 1e6),
    "friction_coefficient": (0.0, 1e-9, 10.0, 1e300),
    "bristle_stiffness": (0.0, 1e-3, 50.0, 1e8, 1e14),
    "bristle_damping": (0.0, 1e6),
    "tolerance": (1e-2, 1e-14),
    "initial_position": (1e300, -1e-300),
    "initial_velocity": (0.5, -1e9, 5e-324),
    "initial_resonator_velocity": (10.0,),
    "initial_bristle_deflection": (1e-6, -1.0),
    "phase": (math.pi, -1e300),
    "load": (0.0851861, 0.2, -1e6, 1e300),
    "frequency_ratio": (0.0, 1e-6, 3.0, 100.0, -1.0, math.sqrt(2.0), 1.0 + 1e-12, 1e300),
}


def devices() -> dict[str, dict[str, float]]:
    """Start values by the name of what they try."""
    named = {name: problem.start_values for name, problem in PROBLEMS.items()}
    for parameter, values in EXTREMES.items():
        named |= {f"{parameter} = {value!r}": {parameter: value} for value in values}
    return named


def script(values: Mapping[str, float], law: int, fidelity: int) -> str:
    """A run of the driver with steps of several sizes, in which the inputs change."""
    lines = []
    for name, value in {**values, "friction_law": law, "fidelity": fidelity}.items():
        (variable,) = (v for v in VARIABLES if v.name == name)
        lines.append(f"{variable.type.lower()} {VALUE_REFERENCE[name]} {value!r}")
    lines.append("initialize")
    for number, (size, count) in enumerate(STEPS):
        lines += [f"step {size!r} {count}", GET]
        if number == 1:
            lines += [
                f"real {VALUE_REFERENCE['phase']} 1.2",
                f"real {VALUE_REFERENCE['load']} 0.03",
            ]
    return "\n".join(lines) + "\n"
