"""The messages between an isolated FMU and the process that started it, pickled.

A request is a task, a function of the instance, and whether it reports progress: it is then called
with a keyword argument `progress`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Started:
    """Calls of the FMU begin: what they need has been loaded."""


@dataclass(frozen=True)
class Progress:
    """What the present task does, empty where that has no name, and its share done, 0 to 1."""

    label: str
    share: float


@dataclass(frozen=True)
class Result:
    """The return value of a task; None once the FMU is open."""

    value: Any = None


@dataclass(frozen=True)
class Failure:
    """The exception that a task raised."""

    error: Exception


TRACEBACK = "traceback.txt"
"""File in the folder of the process with the calls that the FMU was in at its end."""
Request = tuple[Callable[..., Any], bool]
Message = Started | Progress | Result | Failure
"""A message from the process of the FMU."""
