"""Named devices and inputs that trajectory tests share: ordinary, extreme and degenerate."""

import math
from dataclasses import dataclass, field
from typing import Any

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs

SIGNALS = (
    "position",
    "velocity",
    "resonator_displacement",
    "resonator_velocity",
    "normal_force",
    "friction_force",
)
"""The signals that are compared with a reference."""

DURATION = 0.2
MASS_FRACTION = 0.1 / 1.1


@dataclass(frozen=True)
class Problem:
    """Parameters other than table 1, and (start [s], inputs) pieces over DURATION."""

    parameters: dict[str, float] = field(default_factory=dict)
    pieces: tuple[tuple[float, dict[str, Any]], ...] = ((0.0, {}),)

    @property
    def device(self) -> Device:
        return Device.from_mapping(self.parameters)

    @property
    def start_values(self) -> dict[str, float]:
        """Parameters and first inputs."""
        return {**self.parameters, **self.pieces[0][1]}

    @property
    def held(self) -> list[HeldInputs]:
        ends = [start for start, _ in self.pieces[1:]] + [DURATION]
        return [
            HeldInputs(start, end, **inputs)
            for (start, inputs), end in zip(self.pieces, ends, strict=True)
        ]


def under(**inputs: float) -> tuple[tuple[float, dict[str, Any]], ...]:
    return ((0.0, inputs),)


PROBLEMS: dict[str, Problem] = {
    "table 1": Problem(),
    "ratio 3": Problem({}, under(frequency_ratio=3.0, phase=0.4)),
    "ratio 1.37": Problem({}, under(frequency_ratio=1.37)),
    "ratio 0": Problem({}, under(frequency_ratio=0.0, phase=0.7)),
    "ratio -1": Problem({}, under(frequency_ratio=-1.0, phase=0.2)),
    "ratio 1e-6": Problem({}, under(frequency_ratio=1e-6, phase=1.0)),
    "overload": Problem({}, under(load=0.5)),
    "assisting load": Problem({}, under(load=-0.3)),
    "sticking every period": Problem({"base_amplitude": 5e-8}),
    "never moving": Problem({"base_amplitude": 1e-9, "normal_amplitude": 0.5}),
    "lift-off": Problem({"normal_amplitude": 2.0}),
    "lift-off with sticking": Problem({"normal_amplitude": 2.0, "base_amplitude": 5e-8}),
    "undamped, slipping resonance": Problem(
        {"damping_ratio": 0.0, "resonator_frequency": 3500.0 * math.sqrt(1.0 - MASS_FRACTION)}
    ),
    "undamped, sticking resonance": Problem({"damping_ratio": 0.0, "base_amplitude": 5e-8}),
    "damping ratio 1": Problem({"damping_ratio": 1.0}),
    "critical while slipping": Problem({"damping_ratio": math.sqrt(1.0 - MASS_FRACTION)}),
    "damping ratio 1.7": Problem({"damping_ratio": 1.7}),
    "overdamped and sticking": Problem({"damping_ratio": 1.7, "base_amplitude": 2e-7}),
    "massless resonator": Problem({"resonator_mass": 0.0}),
    "heavy resonator": Problem({"slider_mass": 0.1 / 9.0}),
    "direct drive": Problem({"tangential_force": -3.0, "base_amplitude": 0.0}, under(phase=0.5)),
    "one face": Problem({"friction_faces": 1, "friction_coefficient": 0.3}, under(phase=1.0)),
    "initial state": Problem(
        {
            "initial_position": 0.01,
            "initial_velocity": -0.2,
            "initial_resonator_displacement": 3e-4,
            "initial_resonator_velocity": 1.5,
        }
    ),
    "schedule": Problem(
        {},
        (
            (0.0, {"phase": 0.3}),
            (0.0411, {"phase": 1.9, "load": 0.1}),
            (0.08777, {"phase": 1.9, "load": -0.05, "frequency_ratio": 2.0}),
            (0.15, {"phase": -1.0, "load": 0.0, "frequency_ratio": 1.0}),
        ),
    ),
    "soft resonator": Problem({"resonator_frequency": 1.0}, under(phase=0.4)),
    "very soft resonator": Problem(
        {"resonator_frequency": 0.03, "damping_ratio": 1.5}, under(phase=0.4)
    ),
    "softest resonator": Problem(
        {"resonator_frequency": 1e-6}, under(phase=0.4, frequency_ratio=0.0, load=0.3)
    ),
    "no preload": Problem({"normal_preload": 0.0}, under(frequency_ratio=-1.5)),
    "undriven under a lifting contact": Problem(
        {"base_amplitude": 0.0, "normal_amplitude": 1.7}, under(phase=-1.4695858455634698)
    ),
    "no friction": Problem({"friction_coefficient": 0.0}, under(load=0.01)),
    "fidelity 1": Problem({"fidelity": 1}, under(phase=0.4, load=0.05)),
    "fidelity 1, lift-off, ratio 3": Problem(
        {"fidelity": 1, "normal_amplitude": 2.0}, under(frequency_ratio=3.0)
    ),
    "fidelity 1, sticking": Problem({"fidelity": 1, "base_amplitude": 5e-8}),
}
