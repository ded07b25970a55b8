"""Units of the interface in SI base units, and the display units for hosts."""

import math
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Unit:
    """Exponents of the SI base units, and the factor of each display unit.

    A value in a display unit is `factor` times the value in the unit.
    """

    exponents: dict[str, int] = field(default_factory=dict)
    display: dict[str, float] = field(default_factory=dict)


UNITS: dict[str, Unit] = {
    "1": Unit(display={"%": 100.0}),
    "rad": Unit({"rad": 1}, {"deg": 180.0 / math.pi}),
    "rad/s": Unit({"rad": 1, "s": -1}, {"Hz": 0.5 / math.pi}),
    "kg": Unit({"kg": 1}, {"g": 1e3}),
    "m": Unit({"m": 1}, {"mm": 1e3, "um": 1e6}),
    "m/s": Unit({"m": 1, "s": -1}, {"mm/s": 1e3}),
    "s": Unit({"s": 1}, {"ms": 1e3}),
    "N": Unit({"kg": 1, "m": 1, "s": -2}, {"mN": 1e3}),
    "W": Unit({"kg": 1, "m": 2, "s": -3}, {"mW": 1e3}),
    "1/m": Unit({"m": -1}),
    "s/m": Unit({"s": 1, "m": -1}),
}
