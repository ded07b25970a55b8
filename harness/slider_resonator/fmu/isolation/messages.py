"""The messages between an isolated FMU and the process that started it, pickled.

A request is a task, a function of the instance, and whether it reports progress: it is then called
with a keyword argument `progress`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Progress:
    """What the present task does, empty where that has no name, and its share done, 0 to 1."""

    label: str
    share: float


@dataclass(frozen=True)
class Outcome:
    """The `value` of a task or the `error` in its place; neither once the FMU is open."""

    value: Any = None
    error: Exception | None = None

    def result(self) -> Any:
        """Return the value, or raise the error."""
        if self.error is not None:
            raise self.error
        return self.value


TRACEBACK = "traceback.txt"
"""File in the folder of the process with the calls that the FMU was in at its end."""
Request = tuple[Callable[..., Any], bool]
Message = Progress | Outcome
"""A message from the process of the FMU."""
