"""A model: what is resolved of a device, and its friction law."""

from dataclasses import dataclass

COULOMB, LUGRE = 0, 1
LAWS = ("Coulomb", "LuGre")


@dataclass(frozen=True)
class Model:
    """Fidelity 0, 1 or 2 and friction law, 0 Coulomb or 1 LuGre.

    `averaging_order` is that of fidelity 0, None where the FMU has no such parameter.
    """

    fidelity: int
    friction_law: int
    averaging_order: int | None = None

    @property
    def law(self) -> str:
        """The name of the friction law."""
        return LAWS[self.friction_law]

    @property
    def resolution(self) -> str:
        """Fidelity and order in words."""
        order = f", order {self.averaging_order}" if self.averaging_order else ""
        return f"fidelity {self.fidelity}{order}"

    @property
    def name(self) -> str:
        """The model in words."""
        return f"{self.resolution}, {self.law} friction"

    @property
    def parameters(self) -> dict[str, float]:
        """The FMU parameters that make it."""
        order = {"averaging_order": self.averaging_order} if self.averaging_order else {}
        return {"fidelity": self.fidelity, "friction_law": self.friction_law, **order}

    @property
    def leaps(self) -> bool:
        """Whether it leaps over periods, to a tolerance under either friction law."""
        return self.fidelity == 0 and self.averaging_order == 2

    @property
    def averages(self) -> bool:
        """Whether it is the averaged motion of first order."""
        return self.fidelity == 0 and not self.leaps
