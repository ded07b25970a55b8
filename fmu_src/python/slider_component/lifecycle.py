"""The states of FMI 2.0 co-simulation, and which call needs which."""

from __future__ import annotations

from enum import StrEnum

from . import refusal_texts
from .refusal import Refusal


class Lifecycle(StrEnum):
    """State of an instance, by FMI's names."""

    INSTANTIATED = "instantiated"
    INITIALIZATION = "initialization mode"
    STEP_COMPLETE = "step complete"
    TERMINATED = "terminated"


def require(call: str, state: Lifecycle, required: Lifecycle) -> None:
    """Raise Refusal for a call in any state but `required`."""
    if state != required:
        raise Refusal(refusal_texts.wrong_state(call, state, required))
