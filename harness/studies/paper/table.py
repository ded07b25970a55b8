"""A table of the report."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from slider_resonator.fmu.instance import Instance
from studies.paper.figure import Data


@dataclass(frozen=True)
class PaperTable:
    """A table: its columns by name, each with its meaning and unit, and how its rows are measured.

    ``row`` returns the number of each column at one of the values ``over``. ``bounds`` has the
    largest size that each deviation, a column too, may have.
    """

    name: str
    title: str
    caption: str
    columns: Mapping[str, str]
    bounds: Mapping[str, float]
    over: Sequence[float]
    row: Callable[[Instance, float], Mapping[str, float]]

    def measure(self, instance: Instance) -> Data:
        """Return ``rows``, one for each value."""
        return {"rows": [self.row(instance, value) for value in self.over]}

    def largest(self, data: Data) -> dict[str, float]:
        """Return the largest size of each deviation that has a bound."""
        return {name: max(abs(row[name]) for row in data["rows"]) for name in self.bounds}

    def confirmed(self, data: Data) -> bool:
        """Return whether all deviations are within their bounds."""
        return all(size <= self.bounds[name] for name, size in self.largest(data).items())
