"""What is asked of the process that forks a trial, and what it answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from studies.mutants.reach import Place
from studies.mutants.trial import ExpectedPoint, Rejection


@dataclass(frozen=True)
class Bench:
    """An FMU, the points at which variants of it are judged, and the CPU time (s) of each there.

    A variant may take at most `time_limit` (s, of CPU time) for a point.
    """

    fmu: Path
    points: Sequence[ExpectedPoint]
    costs: Sequence[float]
    time_limit: float


@dataclass(frozen=True)
class Attempt:
    """Files of the FMU to replace, by path, and the points of the bench to judge it at, in order.

    With `noting`, the places that noting modules execute are returned for each point.
    """

    changed: Mapping[str, bytes]
    points: Sequence[int]
    noting: bool = False


@dataclass(frozen=True)
class Attempted:
    """The rejection of a variant, if any, `at` a point; with None before the first one.

    `executed` has the noted places of each point that has passed; `cpu_time` is in s.
    """

    rejection: Rejection | None
    at: int | None = None
    executed: Mapping[int, frozenset[Place]] = field(default_factory=dict)
    cpu_time: float = 0.0
