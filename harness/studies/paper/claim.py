"""Statements of the paper, from claims.toml, and the measurements of each."""

import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

from slider_resonator.fmu.instance import Instance


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


@dataclass(frozen=True)
class ClaimGroup:
    """Statements that are measured together."""

    name: str
    title: str
    measures: tuple[Callable[[Instance], Iterable[Claim]], ...]

    def measure(self, instance: Instance) -> list[Claim]:
        """Return all claims as measured."""
        return [claim for measure in self.measures for claim in measure(instance)]


@cache
def statements() -> Mapping[str, Mapping[str, str]]:
    """Return the statements by name: where, statement, verdict and why."""
    file = resources.files("studies.paper") / "claims.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def claim(name: str, confirmed: bool, numbers: Mapping[str, float]) -> Claim:
    """Return the statement of this name with what was measured about it."""
    plain = {label: float(number) for label, number in numbers.items()}
    return Claim(name=name, numbers=plain, confirmed=bool(confirmed), **statements()[name])


def labelled(label: str, numbers: Mapping[float, float]) -> dict[str, float]:
    """Return numbers by what was varied under names: the label and the varied number."""
    return {f"{label}_{varied:g}": number for varied, number in numbers.items()}


def near(found: float, expected: float, share: float) -> bool:
    """Return whether a number differs from another by at most a share of it."""
    return abs(found - expected) <= share * abs(expected)
