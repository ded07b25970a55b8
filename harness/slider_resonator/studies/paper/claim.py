"""One statement of the paper and its measurement."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from slider_resonator.fmu.instance import Instance

AGREES = "agrees"
PARTLY = "agrees in part"
DISAGREES = "disagrees"


@dataclass(frozen=True)
class Claim:
    """A statement, in our words, its place in the paper, and its verdict.

    ``verdict`` is what is known about the statement, ``confirmed`` whether this measurement shows
    it: an FMU for which a verdict is not confirmed is not the device of the paper.
    """

    name: str
    where: str
    statement: str
    numbers: Mapping[str, float]
    verdict: str
    why: str
    confirmed: bool

    def plain(self) -> dict[str, Any]:
        """Return the claim as JSON holds it."""
        return asdict(self) | {
            "numbers": {name: float(value) for name, value in self.numbers.items()},
            "confirmed": bool(self.confirmed),
        }


@dataclass(frozen=True)
class ClaimGroup:
    """Statements that are measured together."""

    name: str
    title: str
    measures: tuple[Callable[[Instance], list[Claim]], ...]

    def measure(self, instance: Instance) -> list[Claim]:
        """Return all claims as measured."""
        return [claim for measure in self.measures for claim in measure(instance)]


def near(found: float, expected: float, share: float) -> bool:
    """Return whether a number differs from another by at most a share of it."""
    return abs(found - expected) <= share * abs(expected)
