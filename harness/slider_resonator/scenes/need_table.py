"""The table [need] of a scene file."""

from typing import ClassVar, Literal

from pydantic import model_validator

from slider_resonator.scenes.key_table import KeyTable, Positive, key

STEADY_NEEDS = ("steady_velocity", "blocking_force")
"""Needs in the steady motion under constant inputs."""
RUN_NEEDS = (
    *("mean_velocity", "mean_velocity_throughout", "position", "velocity"),
    *("event_times", "beat"),
)
"""Needs that are measured in a run."""


class AllowedTable(KeyTable):
    """Allowed error of a needed quantity: `abs + rel * size`, where either may be left out.

    `abs` is in the quantity's unit. The size is the magnitude of a number, the peak of a signal and
    the drive period for event times.
    """

    rules: ClassVar[tuple[str, ...]] = ("At least one of `abs` and `rel`.",)

    abs: Positive | None = key("allowed error", 2e-3, unit="unit of the quantity")
    rel: Positive | None = key(
        "allowed error as a share of the size: the magnitude of a number, the peak of a signal, "
        "the drive period for event times",
        0.01,
        unit="1",
    )

    @model_validator(mode="before")
    @classmethod
    def _a_table(cls, value: object) -> object:
        if not isinstance(value, dict):
            raise ValueError("must be a table with abs or rel, such as { rel = 0.01 }")
        return value

    @model_validator(mode="after")
    def _some_tolerance(self) -> "AllowedTable":
        if self.abs is None and self.rel is None:
            raise ValueError("needs a tolerance: abs, rel or both")
        return self

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

    @model_validator(mode="after")
    def _some_need(self) -> "NeedTable":
        if not self.needs:
            raise ValueError(f"needs at least one of {', '.join((*STEADY_NEEDS, *RUN_NEEDS))}")
        return self

    @property
    def needs(self) -> dict[str, AllowedTable]:
        """The needed quantities by name."""
        return self.given((*STEADY_NEEDS, *RUN_NEEDS))
