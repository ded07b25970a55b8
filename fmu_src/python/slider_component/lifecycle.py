"""The states of FMI 2.0 co-simulation and the calls that each allows."""

from __future__ import annotations

from enum import StrEnum

from .refusal import Refusal


class Lifecycle(StrEnum):
    """State of an instance, by FMI's names."""

    INSTANTIATED = "instantiated"
    INITIALIZATION = "initialization mode"
    STEP_COMPLETE = "step complete"
    TERMINATED = "terminated"


def require(call: str, state: Lifecycle, *allowed: Lifecycle) -> None:
    """Raise Refusal, naming call, state and the states that allow it, unless `state` does."""
    if state not in allowed:
        raise Refusal(
            f"{call} refused in state '{state}': allowed in "
            + " or ".join(f"'{a}'" for a in allowed)
        )
