"""A table of the report."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from slider_resonator.fmu.instance import Instance
from studies.paper.figure import Data


@dataclass(frozen=True)
class PaperTable:
    """A table: its columns by name, each with its meaning and unit, and how its rows are measured.

    ``measure`` returns ``rows``, a list of mappings from column to number. ``bounds`` has the
    largest size that each deviation, a column too, may have.
    """

    name: str
    title: str
    caption: str
    columns: Mapping[str, str]
    bounds: Mapping[str, float]
    measure: Callable[[Instance], Data]

    def largest(self, data: Data) -> dict[str, float]:
        """Return the largest size of each deviation that has a bound."""
        return {name: max(abs(row[name]) for row in data["rows"]) for name in self.bounds}

    def confirmed(self, data: Data) -> bool:
        """Return whether all deviations are within their bounds."""
        return all(size <= self.bounds[name] for name, size in self.largest(data).items())


def rows_over(
    values: Sequence[float], row: Callable[[Instance, float], Mapping[str, float]]
) -> Callable[[Instance], Data]:
    """Return the measurement of a table with one row for each value."""
    return lambda instance: {"rows": [row(instance, value) for value in values]}
