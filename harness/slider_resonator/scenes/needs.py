"""What a scene needs, and how accurately, for the command choose."""

from math import inf
from typing import ClassVar, Literal

from slider_resonator.device.units import si_number
from slider_resonator.errors import unknown_name
from slider_resonator.scenes.key_table import KeyTable, Positive, key, units_of

STEADY_NEEDS = ("steady_velocity", "blocking_force")
"""Needs in the steady motion under constant inputs."""
RUN_NEEDS = (
    *("mean_velocity", "mean_velocity_throughout", "position", "velocity"),
    *("event_times", "beat"),
)
"""Needs that are measured in a run."""


class AllowedTable(KeyTable):
    """Allowed error of a needed quantity: `abs + rel * size`, where either may be left out.

    `abs` is in the quantity's unit; the size is that of `rel`.
    """

    rules: ClassVar[tuple[str, ...]] = ("At least one of `abs` and `rel`.",)
    some_of = ("abs", "rel")

    abs: Positive | None = key("allowed error", 2e-3, unit="unit of the quantity")
    rel: Positive | None = key(
        "allowed error as a share of the size: the magnitude of a number, the peak of a signal, "
        "the drive period for event times",
        0.01,
        unit="1",
    )

    def at(self, size: float) -> float:
        """Return the allowed error for a quantity of this size, both in the quantity's unit."""
        return (self.abs or 0.0) + (self.rel or 0.0) * abs(size)


class NeedTable(KeyTable):
    """The quantities that the scene needs, and how accurately: the command choose meets them."""

    rules: ClassVar[tuple[str, ...]] = (
        "At least one quantity, each with `abs`, `rel` or both.",
        "`steady_velocity` and `blocking_force` need constant inputs and parameters; the others "
        "need a [run].",
    )
    some_of = (*STEADY_NEEDS, *RUN_NEEDS)

    mean_velocity: AllowedTable | None = key(
        "mean velocity over the last drive period of the run", {"rel": 0.02}, unit="m/s"
    )
    mean_velocity_throughout: AllowedTable | None = key(
        "mean velocity over the last drive period at each communication point from the end of the "
        "first period on",
        {"abs": 1e-3},
        unit="m/s",
    )
    position: AllowedTable | None = key(
        "position at each communication point", {"abs": 2e-3}, unit="m"
    )
    velocity: AllowedTable | None = key(
        "velocity at each communication point", {"rel": 0.01}, unit="m/s"
    )
    steady_velocity: AllowedTable | None = key(
        "mean velocity of the steady motion", {"rel": 0.01}, unit="m/s"
    )
    blocking_force: AllowedTable | None = key(
        "load under which the mean velocity is zero", {"abs": 1e-3}, unit="N"
    )
    event_times: AllowedTable | None = key("time of each event", {"rel": 0.01}, unit="s")
    beat: AllowedTable | None = key(
        "frequency of the slow velocity beside an integer ratio", {"rel": 0.05}, unit="Hz"
    )
    friction_law: Literal["given", "free"] = key(
        "whether either friction law may be chosen", "free", default="given"
    )

    @property
    def needs(self) -> dict[str, AllowedTable]:
        """The needed quantities by name."""
        return self.given(self.some_of)


def allowed_error(name: str, error: str) -> AllowedTable:
    """Return the allowed error of a needed quantity: a share in %, or a number in its unit.

    Raises ValueError with name, error and requirement.
    """
    units = units_of(NeedTable)
    if name not in units:
        raise ValueError(unknown_name("quantity", name, units))
    if error.rstrip().endswith("%"):
        allowed = {"rel": si_number(name, error, "1")}
    else:
        allowed = {"abs": si_number(name, error, units[name])}
    if not 0.0 < min(allowed.values()) < inf:
        raise ValueError(f"{name} = {error!r}: must be above 0, and finite")
    return AllowedTable(**allowed)
