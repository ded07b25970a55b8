"""The device parameters of the contract: SI units, and table 1 of the paper as start values."""

from collections.abc import Iterable, Mapping
from copy import copy
from dataclasses import dataclass, field, fields
from typing import Any

from slider_resonator.device.variable import Variable
from slider_resonator.errors import explained

FULL = 2
"""Fidelity of the full device."""

DEVIATIONS = ("amplitude_deviation", "frequency_deviation")
"""Inputs by which the drive differs from what the parameters say, relative to these."""


def _value(start: float, unit: str, minimum: float | None = None, **about: Any) -> Any:
    """Return a field with the rest of what `Variable` says of the parameter: Integer, or Real."""
    kind = "Integer" if isinstance(start, int) else "Real"
    nominal = None if kind == "Integer" else start
    usual = {"variability": "fixed", "kind": kind, "nominal": nominal}
    return field(default=start, metadata={**usual, "unit": unit, "minimum": minimum, **about})


@dataclass(frozen=True, repr=False)
class Device:
    """Parameters of the slider with an embedded resonator, SI units, start values of table 1.

    Names are those of the FMU parameters. ``friction_law`` is 0 (Coulomb) or 1 (LuGre),
    ``fidelity`` the number of resolved degrees of freedom (0 averaged, 1, 2), and
    ``averaging_order`` 1 averages or 2 leaps over periods. A value may be a text with a unit.
    Raises SceneError, with name, value and requirement.
    """

    slider_mass: float = _value(1.0, "kg", 1e-12)
    resonator_mass: float = _value(0.1, "kg", 0.0)
    resonator_frequency: float = _value(3500.0, "rad/s", 1e-6)
    damping_ratio: float = _value(0.05, "1", 0.0)
    normal_preload: float = _value(1.0, "N", 0.0, variability="tunable")
    normal_amplitude: float = _value(1.0, "N", 0.0, variability="tunable")
    base_amplitude: float = _value(1e-4, "m", 0.0, variability="tunable")
    drive_frequency: float = _value(3500.0, "rad/s", 1e-6, variability="tunable")
    tangential_force: float = _value(0.0, "N", nominal=1.0, variability="tunable")
    friction_coefficient: float = _value(0.1, "1", 0.0, variability="tunable")
    friction_faces: int = _value(2, "1", 1, maximum=2)
    friction_law: int = _value(0, "1", 0, maximum=1)
    bristle_stiffness: float = _value(1e5, "1/m", 0.0)
    bristle_damping: float = _value(10.0, "s/m", 0.0)
    fidelity: int = _value(2, "1", 0, maximum=2)
    tolerance: float = _value(1e-8, "1", 1e-14, maximum=1e-2)
    initial_position: float = _value(0.0, "m", nominal=1e-3)
    initial_velocity: float = _value(0.0, "m/s", nominal=0.1)
    initial_resonator_displacement: float = _value(0.0, "m", nominal=1e-3)
    initial_resonator_velocity: float = _value(0.0, "m/s", nominal=1.0)
    initial_bristle_deflection: float = _value(0.0, "m", nominal=1e-6)
    averaging_order: int = _value(2, "1", 1, maximum=2, since="0.2.0", without=1)

    def __post_init__(self) -> None:
        with explained():
            read = {one.name: one.read(getattr(self, one.name)) for one in PARAMETER_TABLE}
        vars(self).update(read)

    def __repr__(self) -> str:
        """Return what differs from table 1, as the call that makes it."""
        return f"Device({', '.join(f'{n}={value!r}' for n, value in self.differing.items())})"

    @property
    def differing(self) -> dict[str, float]:
        """The parameters that differ from table 1."""
        start = vars(Device())
        return {name: value for name, value in vars(self).items() if value != start[name]}

    @classmethod
    def from_mapping(cls, values: Mapping[str, float]) -> "Device":
        """Return table 1 with the given parameters replaced, its drive under given deviations.

        Raises SceneError, with name, value and requirement.
        """
        given: dict[str, Any] = {n: v for n, v in values.items() if n not in DEVIATIONS}
        return cls(**given).tuned((name, values.get(name, 0.0)) for name in DEVIATIONS)

    def tuned(self, values: Iterable[tuple[str, float]]) -> "Device":
        """Return the device as it is in a run while parameters and `DEVIATIONS` have these values.

        Nothing is checked: a drive may deviate, and a search try, beyond the bounds of parameters.
        """
        device = copy(self)
        own = vars(device)
        own.update(values)
        amplitude, frequency = (1.0 + own.pop(name, 0.0) for name in DEVIATIONS)
        own["base_amplitude"] *= amplitude
        own["tangential_force"] *= amplitude
        own["drive_frequency"] *= frequency
        return device

    @property
    def total_mass(self) -> float:
        """Mass of slider and resonator together, kg."""
        return self.slider_mass + self.resonator_mass

    @property
    def mass_ratio(self) -> float:
        """Resonator mass over total mass, r_m below (29)."""
        return self.resonator_mass / self.total_mass

    @property
    def mean_friction(self) -> float:
        """Friction of all faces at the mean normal load of a closed contact, faces mu N0, N."""
        return self.friction_faces * self.friction_coefficient * self.normal_preload

    @property
    def max_normal_force(self) -> float:
        """Largest normal load, N."""
        return self.normal_preload + self.normal_amplitude

    @property
    def max_friction(self) -> float:
        """Friction of all faces at the largest normal load, N."""
        return self.friction_faces * self.friction_coefficient * self.max_normal_force

    @property
    def amplitude_ratio(self) -> float:
        """Amplitude over mean of the normal load, alpha below (2)."""
        return self.normal_amplitude / self.normal_preload

    @property
    def stiffness(self) -> float:
        """Resonator stiffness k, N/m."""
        return self.resonator_mass * self.resonator_frequency**2

    @property
    def damping(self) -> float:
        """Resonator damping c, N s/m."""
        return 2.0 * self.damping_ratio * self.resonator_mass * self.resonator_frequency


PARAMETER_TABLE = tuple(
    Variable(one.name, "parameter", start=getattr(Device, one.name), **one.metadata)
    for one in fields(Device)
)
"""What is said of each parameter."""
