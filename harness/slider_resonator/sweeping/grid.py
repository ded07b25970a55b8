"""What a sweep computes, read from a TOML file: the points, the measures, and how to run them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, product
from math import exp, log, prod
from pathlib import Path
from random import Random
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Discriminator, Field, Tag, field_validator, model_validator

from slider_resonator.device.drive_periods import MAX_DENOMINATOR
from slider_resonator.device.interface import SETTABLE, VARIABLES
from slider_resonator.errors import HarnessError, explained, unknown_name
from slider_resonator.scenes.device_file import possible_slips, refuse_other_kinds
from slider_resonator.scenes.key_table import KeyTable, Number, ParametersTable
from slider_resonator.scenes.scene_files import built_in_scenes
from slider_resonator.scenes.table_reading import AXIS, table_from
from slider_resonator.scenes.toml_file import read_toml
from slider_resonator.sweeping.measures import Counted, Run, Task, check_measure

MAX_POINTS = 10_000_000
"""More would not fit into the memory of the process that writes the table."""

Rows = tuple[tuple[float, ...], ...]
"""The values of some variables, point by point."""


class RangeTable(KeyTable):
    """Values between two numbers."""

    first: Number = Field(alias="from", examples=[0.0])
    last: Number = Field(alias="to", examples=[1.0])
    spacing: Literal["linear", "log"] = "linear"

    @model_validator(mode="after")
    def _is_a_range(self) -> "RangeTable":
        if self.first == self.last:
            raise ValueError(f"from {self.first!r} to {self.last!r}: must be two different numbers")
        if self.spacing == "log" and not (self.first > 0.0 and self.last > 0.0):
            raise ValueError(f"from {self.first!r} to {self.last!r}: must be above 0 for log")
        return self

    def value(self, share: float) -> float:
        """Return the value at a share of the way; the ends are met exactly."""
        if share in (0.0, 1.0):
            return self.first if share == 0.0 else self.last
        if self.spacing == "log":
            return exp(log(self.first) + (log(self.last) - log(self.first)) * share)
        return self.first + (self.last - self.first) * share


class AxisTable(RangeTable):
    """Equally spaced values of an axis, the two numbers among them."""

    count: Annotated[int, Field(strict=True, ge=2, le=MAX_POINTS, examples=[11])]

    @property
    def values(self) -> tuple[float, ...]:
        """The values, from the first on."""
        return tuple(self.value(index / (self.count - 1)) for index in range(self.count))


Values = Annotated[tuple[Number, ...], Field(min_length=1)]
Axis = Annotated[
    Annotated[Values, Tag(AXIS[0])] | Annotated[AxisTable, Tag(AXIS[1])],
    Discriminator(lambda given: AXIS[isinstance(given, dict | AxisTable)]),
]


class RandomTable(KeyTable):
    """A random sample of points: a range for each variable."""

    model_config = ConfigDict(extra="allow", frozen=True)
    __pydantic_extra__: dict[str, RangeTable]
    count: Annotated[int, Field(strict=True, ge=1, le=MAX_POINTS, examples=[1000])]
    seed: Annotated[int, Field(strict=True, ge=0, examples=[1])]

    @model_validator(mode="after")
    def _some_variable(self) -> "RandomTable":
        if not self.__pydantic_extra__:
            example = "load = { from = 0, to = 0.05 }"
            raise ValueError(f"no variable; must have some, such as {example}")
        return self

    def rows(self) -> Rows:
        """Return the points; Python's own generator: the same on every platform and version."""
        random, ranges = Random(self.seed), self.__pydantic_extra__.values()
        return tuple(tuple(one.value(random.random()) for one in ranges) for _ in range(self.count))


class GridTable(KeyTable):
    """A grid file."""

    title: str = ""
    measures: tuple[str, ...] = ("steady_velocity",)
    max_denominator: Counted = MAX_DENOMINATOR
    device: ParametersTable = ParametersTable()
    fixed: dict[str, Number] = Field(default={})
    grid: dict[str, Axis] = Field(default={})
    parallel: dict[str, Values] = Field(default={}, alias="list")
    random: RandomTable | None = None
    run: Run = Run()

    @field_validator("measures", mode="before")
    @classmethod
    def _known_measures(cls, names: Any) -> Any:
        if not isinstance(names, list) or not names or len(set(map(str, names))) < len(names):
            raise ValueError("must be a list of different measures")
        for name in names:
            check_measure(name)
        return names

    @model_validator(mode="after")
    def _possible(self) -> "GridTable":
        if not self.names:
            raise ValueError("nothing is varied; must have any of [grid], [list] and [random]")
        names = [*self.names, *self.fixed]
        for name in names:
            if name not in SETTABLE:
                raise ValueError(unknown_name("parameter or input", name, SETTABLE))
            if names.count(name) > 1:
                raise ValueError(f"{name} is given more than once; must be in one place")
        lengths = {name: len(values) for name, values in self.parallel.items()}
        if len(set(lengths.values())) > 1:
            shown = ", ".join(f"{name} {length}" for name, length in lengths.items())
            raise ValueError(f"[list]: the lengths differ ({shown}); must be of equal length")
        sizes = [len(a) if isinstance(a, tuple) else a.count for a in self.grid.values()]
        sizes += [*lengths.values()][:1] + ([self.random.count] if self.random else [])
        if prod(sizes) > MAX_POINTS:
            raise ValueError(f"{prod(sizes)} points; must be at most {MAX_POINTS}")
        return self

    @property
    def names(self) -> tuple[str, ...]:
        """What is varied, in the order of the columns."""
        drawn = self.random.__pydantic_extra__ if self.random else {}
        return (*self.grid, *self.parallel, *drawn)

    @property
    def points(self) -> Rows:
        """The values of `names`, point by point: what is written last varies fastest."""
        axes = [a if isinstance(a, tuple) else a.values for a in self.grid.values()]
        factors: list[Rows] = [tuple(product(*axes))] if axes else []
        factors += [tuple(zip(*self.parallel.values(), strict=True))] if self.parallel else []
        factors += [self.random.rows()] if self.random else []
        return tuple(tuple(chain.from_iterable(rows)) for rows in product(*factors))

    @property
    def logarithmic(self) -> frozenset[str]:
        """The variables with that spacing."""
        drawn = self.random.__pydantic_extra__ if self.random else {}
        ranges = {**self.grid, **drawn}.items()
        return frozenset(name for name, one in ranges if getattr(one, "spacing", "") == "log")


@dataclass(frozen=True)
class Sweep:
    """A valid sweep.

    `points` are the values of `task.names`, one tuple each, in the order of the rows of the table.
    `is_grid` says that they are a full product of axes and nothing else,
    `logarithmic` are the variables with that spacing. `slips` is a sentence for each value that may
    be meant in another unit.
    """

    title: str
    task: Task
    points: Rows
    is_grid: bool
    logarithmic: frozenset[str] = frozenset()
    slips: Sequence[str] = ()


def read_grid(
    path: Path,
    device: Mapping[str, float] | None = None,
    settings: Mapping[str, float] | None = None,
) -> Sweep:
    """Read a grid file; raises HarnessError with file, key, value and requirement.

    `device` has parameters that its own [device], [fixed] and what varies leave out; `settings`
    replace what is not varied, inputs too.
    """
    if not path.exists() and str(path) in built_in_scenes():
        raise HarnessError(
            f"{path}: is a scene; must be a grid file. Use it in `slider-resonator run {path}`"
        )
    content = read_toml(path)
    refuse_other_kinds(content, str(path), "grid")
    return grid_from(content, str(path), device, settings)


def grid_from(
    content: Mapping[str, Any],
    source: str,
    device: Mapping[str, float] | None = None,
    settings: Mapping[str, float] | None = None,
) -> Sweep:
    """Return the sweep of parsed TOML, or data of the same form, as `read_grid` does.

    Raises HarnessError with `source`.
    """
    table = table_from(GridTable, content, source)
    points = table.points
    settings = settings or {}
    for name in table.names:
        if name in settings:
            raise HarnessError(
                f"--set {name}={settings[name]:g}: {source} varies {name}; must be one of the two"
            )
    own = {**(device or {}), **table.device.stated}
    fixed = {name: value for name, value in own.items() if name not in table.names} | table.fixed
    fixed |= settings
    columns = dict(zip(table.names, map(set, zip(*points, strict=True)), strict=True))
    columns |= {name: {value} for name, value in table.fixed.items()}
    for name, values in columns.items():
        for value in values:
            with explained(f"{source}: "):
                VARIABLES[name].read(value)
    task = Task(
        names=table.names,
        fixed=tuple((name, float(value)) for name, value in fixed.items()),
        measures=table.measures,
        max_denominator=table.max_denominator,
        run=table.run,
    )
    is_grid = not table.parallel and table.random is None
    plain = {**content.get("device", {}), **content.get("fixed", {})}
    plain |= {name: max(values, key=abs) for name, values in columns.items()}
    slips = possible_slips(plain, own)
    return Sweep(table.title, task, points, is_grid, table.logarithmic, slips)
