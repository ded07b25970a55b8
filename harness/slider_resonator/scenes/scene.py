"""Scenes as data: what is run and what is expected; read from TOML files."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import pi
from pathlib import Path
from typing import Any

from slider_resonator.device.device import DEVIATIONS, Device
from slider_resonator.device.drive_periods import DrivePeriods, drive_periods
from slider_resonator.device.interface import INPUT_STARTS, INPUTS, TUNABLES, VARIABLES
from slider_resonator.device.schedule import Schedule, schedule, step_count
from slider_resonator.device.signal import Signal, constant, through
from slider_resonator.errors import SceneError, explained, unknown_name
from slider_resonator.output.readable import number_of
from slider_resonator.output.shown import Shown
from slider_resonator.scenes.csv_signal import csv_signal
from slider_resonator.scenes.device_file import possible_slips, read_device_file, refuse_other_kinds
from slider_resonator.scenes.expansion import variants
from slider_resonator.scenes.needs import RUN_NEEDS, STEADY_NEEDS, AllowedTable, NeedTable
from slider_resonator.scenes.schema import ExpectTable, InputTable, RunTable, SceneTable, SweepTable
from slider_resonator.scenes.table_reading import table_from
from slider_resonator.scenes.toml_file import read_toml
from slider_resonator.scenes.vocabulary import QUANTITIES


@dataclass(frozen=True, repr=False)
class Scene(Shown):
    """A valid scene; it can be pickled.

    Raises SceneError for a run of too many steps, or one that goes beyond the values of a CSV file.

    `parameters` are the device parameters that differ from their start, `signals` the inputs by
    name, `tuning` what changes in the run and is held over a step: tunable parameters, deviations
    of the drive. Deviations that are constant are among the parameters. `source` names the scene in
    messages; `files` are all that it was read from. `slips` is a sentence for each value of its
    device that may be meant in another unit.
    """

    name: str
    title: str
    description: str
    source: str
    parameters: Mapping[str, float]
    signals: Mapping[str, Signal]
    run: RunTable | None
    expect: tuple[ExpectTable, ...]
    sweep: SweepTable | None
    need: NeedTable | None
    files: tuple[Path, ...]
    tuning: Mapping[str, Signal] = field(default_factory=dict)
    slips: Sequence[str] = ()

    def __post_init__(self) -> None:
        if self.stop_time is not None:
            with explained(f"{self.source}: run: "):
                step_count(self.stop_time, self._steps)
        for key, signal in self._all_signals.items():
            with explained(f"{self.source}: {key}: "):
                signal.check_covers(self.stop_time or 0.0)
        self._check_what_is_asked()

    def _check_what_is_asked(self) -> None:
        """Raise SceneError for the first thing that needs a run or constant values in vain."""
        # Deviations of a drive that is tuned change with it.
        signals = {**self.signals, **self.tuning}
        changing = [n for n, s in signals.items() if len(s.times) > 1]
        changing += [name for name in DEVIATIONS if name in self.tuning]
        asked = [(f"expect: {one.quantity}", QUANTITIES[one.quantity]) for one in self.expect]
        in_run = [f"tuning.{name}" for name in TUNABLES if name in self.tuning]
        in_run += [key for key, quantity in asked if quantity.needs_run]
        constant = [key for key, quantity in asked if quantity.needs_constants]
        needs = self.need.needs if self.need else ()
        in_run += [f"need.{name}" for name in needs if name in RUN_NEEDS]
        constant += [f"need.{name}" for name in needs if name in STEADY_NEEDS]
        wrong = [] if self.run else [f"{key} needs a run: [run] is missing" for key in in_run]
        if self.sweep and self.sweep.variable in changing:
            wrong.append(f"sweep.variable = {self.sweep.variable!r}: must be constant in the run")
        if changing:
            wrong += [f"{key} needs constant inputs and parameters" for key in constant]
        if wrong:
            raise SceneError(f"{self.source}: {wrong[0]}")

    @property
    def _all_signals(self) -> dict[str, Signal]:
        """All values over time, by the key of the scene file."""
        return {
            f"{'tuning' if name in TUNABLES else 'inputs'}.{name}": signal
            for name, signal in {**self.signals, **self.tuning}.items()
        }

    @property
    def device(self) -> Device:
        """The device with all its parameters."""
        return Device.from_mapping(self.parameters)

    @property
    def drive_period(self) -> float:
        """Drive period in seconds, without what is tuned."""
        return 2.0 * pi / self.device.drive_frequency

    @cached_property
    def drive_periods(self) -> DrivePeriods:
        """The drive periods of its run, in which the drive may be tuned."""
        if not self.tuning:
            return DrivePeriods(self.drive_period)
        return drive_periods(self.device, self.schedule().held())

    @property
    def stop_time(self) -> float | None:
        """Length of the run in seconds, None for a scene without a run."""
        if self.run is None:
            return None
        return self.run.stop_time or (self.run.drive_periods or 0.0) * self.drive_period

    @property
    def start_time(self) -> float:
        """Time at which the run starts, s; all others count from there."""
        return self.run.start_time if self.run else 0.0

    @property
    def step_size(self) -> float | None:
        """Communication step in seconds, the largest of several; None for a scene without a run."""
        return None if self.run is None else max(self._steps)

    @property
    def _steps(self) -> tuple[float, ...]:
        if self.run is None:
            return ()
        if self.run.step_sizes is not None:
            return self.run.step_sizes
        per_period = self.run.steps_per_period or 1.0
        return (self.run.step_size or self.drive_period / per_period,)

    @property
    def values(self) -> dict[str, float]:
        """Parameters, and inputs as they are at the start."""
        return {**self.parameters, **{name: s.at(0.0) for name, s in self.signals.items()}}

    def describe(self) -> list[str]:
        """Return name, device, inputs and run, and how much is expected."""
        differs = ", ".join(f"{name} = {value:g}" for name, value in self.parameters.items())
        lines = [f"{self.name}: {self.title}", f"device   {differs or 'table 1'}"]
        for key, signal in self._all_signals.items():
            values = signal.values
            span = f"{min(values):g} to {max(values):g}" if len(values) > 1 else f"{values[0]:g}"
            lines.append(f"{key}  {span}")
        if self.run is not None:
            lines.append(f"run      {self.stop_time:.6g} s in steps of {self.step_size:.6g} s")
        lines.append(f"expects  {number_of(len(self.expect), 'value')} at each point")
        return lines

    def schedule(self) -> Schedule:
        """Return inputs and communication points; SceneError for a scene without a run."""
        if self.run is None or self.stop_time is None:
            raise SceneError(
                f"{self.source}: scene {self.name} has no [run] and cannot be run; the command "
                "scenes shows which can"
            )
        plan = schedule(
            self.stop_time, self._steps, self.tuning, self.run.interpolate, **self.signals
        )
        return replace(plan, start_time=self.start_time, reads_twice=self.run.read_twice)

    def with_values(self, values: Mapping[str, float]) -> "Scene":
        """Return the scene with parameters replaced, and inputs by a constant.

        The values must be ones that the interface has.
        """
        tuning = {name: s for name, s in self.tuning.items() if name not in values}
        held = (*INPUTS, *(DEVIATIONS if tuning else ()))
        inputs = {name: constant(value) for name, value in values.items() if name in held}
        tuning |= {name: inputs.pop(name) for name in DEVIATIONS if name in inputs}
        parameters = {name: value for name, value in values.items() if name not in held}
        return replace(
            self,
            parameters={**self.parameters, **parameters},
            signals={**self.signals, **inputs},
            tuning=tuning,
        )

    @property
    def heading(self) -> str:
        """Title and name, for pictures."""
        return self.title if self.name in self.title else f"{self.title}  ({self.name})"

    def with_device(self, device: Mapping[str, float]) -> "Scene":
        """Return the scene with another device, or as it is if `device` states nothing.

        What `device` leaves out is that of table 1, but the state at the start, fidelity, tolerance
        and what is tuned in the run stay those of the scene.
        """
        if not device:
            return self
        kept = {
            name: value
            for name, value in self.parameters.items()
            if name in ("fidelity", "tolerance") or name.startswith("initial_")
        }
        return replace(self.with_values(device), parameters={**kept, **device})

    def timed(self, *, stop_time: float | None = None, step_size: float | None = None) -> "Scene":
        """Return the scene with a run of another length, or in other steps, in s; None keeps them.

        Messages about it name the scene, as its file does not say so.
        Raises SceneError for a scene without a run, and as a scene does.
        """
        if stop_time is None and step_size is None:
            return self
        if self.run is None:
            raise SceneError(f"{self.source}: scene {self.name} has no [run] that could be changed")
        changed: dict[str, float | None] = {}
        if stop_time is not None:
            changed |= {"stop_time": stop_time, "drive_periods": None}
        if step_size is not None:
            changed |= {"step_size": step_size, "steps_per_period": None, "step_sizes": None}
        return replace(self, source=self.name, run=self.run.model_copy(update=changed))

    def needing(self, needs: Mapping[str, AllowedTable]) -> "Scene":
        """Return the scene with other needs for the command choose.

        Raises SceneError for one that needs a run, or constant inputs, where the scene has none.
        """
        return replace(self, need=NeedTable.model_validate(needs))

    @property
    def interpolates(self) -> bool:
        """Whether it passes straight lines of inputs on as derivatives, and has any."""
        return self.run is not None and self.run.interpolate and self.schedule().ramps

    def interpolating(self, interpolate: bool) -> "Scene":
        """Return the scene with straight lines of inputs passed on as derivatives, or held."""
        if self.run is None:
            return self
        return replace(self, run=self.run.model_copy(update={"interpolate": interpolate}))

    def lines_reach(self, interpolates: bool) -> str | None:
        """Return how straight lines of inputs reach an FMU, None without any.

        They are "interpolated", "held", or held where they should not be as it "cannot".
        """
        if self.run is None or not self.interpolating(True).interpolates:
            return None
        if not self.run.interpolate:
            return "held"
        return "interpolated" if interpolates else "cannot"

    def points(self) -> tuple["ScenePoint", ...]:
        """Return the points of the sweep, or without a sweep the scene as its only point."""
        if self.sweep is None:
            return (ScenePoint(self),)
        swept = ({self.sweep.variable: value} for value in self.sweep.values)
        return tuple(ScenePoint(self.with_values(at), at) for at in swept)


@dataclass(frozen=True, eq=False)
class ScenePoint:
    """A scene at a point of its sweep: `at` are the varied values, empty without a sweep.

    Points are equal only to themselves, and can be keys.
    """

    scene: Scene
    at: Mapping[str, float] = field(default_factory=dict)


def read_scenes(path: Path, name: str | None = None) -> tuple[Scene, ...]:
    """Read the scenes of a file: one, or its variants; with a `name` that one alone.

    Raises SceneError with file, key, value and what is allowed.
    """
    contents = variants(read_toml(path), str(path))
    if name is not None and name not in contents:
        raise SceneError(f"{path}: {unknown_name('scene', name, contents)}")
    scenes = (
        _scene(content, f"{path}#{one}" if len(contents) > 1 else str(path), path.parent)
        for one, content in contents.items()
        if name in (None, one)
    )
    return tuple(replace(scene, files=(path, *scene.files)) for scene in scenes)


def scene_from(content: Mapping[str, Any], source: str, folder: Path = Path()) -> Scene:
    """Return the scene of parsed TOML, or data of the same form, whose CSV files are in `folder`.

    Raises SceneError with `source`, key, value and what is allowed.
    """
    contents = variants(content, source)
    return only_scene([_scene(one, source, folder) for one in contents.values()], source)


def only_scene(scenes: Sequence[Scene], source: str) -> Scene:
    """Return the only one of the scenes of a file; SceneError for several."""
    if len(scenes) > 1:
        names = ", ".join(scene.name for scene in scenes)
        raise SceneError(f"{source}: has the scenes {names}; must be one: {source}#NAME")
    return scenes[0]


def _scene(content: Mapping[str, Any], source: str, folder: Path) -> Scene:
    if "name" not in content:
        refuse_other_kinds(content, source, "scene")
    files: list[Path] = []
    stated = content
    if isinstance(name := content.get("device"), str):
        try:
            read = read_device_file(name, folder)
        except SceneError as error:
            raise SceneError(f"{source}: device: {error}") from error
        stated, files = {**content, "device": read.values}, [read.path]
    table = table_from(SceneTable, stated, source)

    def signals(tables: Mapping[str, InputTable], where: str) -> dict[str, Signal]:
        files.extend(folder / table.csv for table in tables.values() if table.csv)
        return {n: _signal(t, n, f"{source}: {where}.{n}", folder) for n, t in tables.items()}

    inputs = {name: constant(start) for name, start in INPUT_STARTS.items()}
    inputs |= signals(table.inputs.given(INPUTS), "inputs")
    tuning = signals(table.tuning.given(TUNABLES), "tuning")
    starts = {name: s.at(0.0) for name, s in tuning.items()}
    deviating = signals(table.inputs.given(DEVIATIONS), "inputs")
    if tuning or any(len(signal.times) > 1 for signal in deviating.values()):
        tuning |= deviating
    else:
        starts |= {name: signal.at(0.0) for name, signal in deviating.items()}
    plain = {**stated.get("device", {}), "phase": stated.get("inputs", {}).get("phase")}
    return Scene(
        name=table.name,
        title=table.title,
        description=table.description.strip(),
        source=source,
        parameters={**table.device.stated, **starts},
        signals=inputs,
        run=table.run,
        expect=table.expect,
        sweep=table.sweep,
        need=table.need,
        files=tuple(files),
        tuning=tuning,
        slips=read.slips if isinstance(name, str) else possible_slips(plain),
    )


def _signal(table: InputTable, name: str, where: str, folder: Path) -> Signal:
    with explained(f"{where}: "):
        if table.steps is not None:
            signal = through(table.steps)
        elif table.ramp is not None:
            signal = through(table.ramp, hold=False)
        elif table.csv is not None:
            unit = VARIABLES[name].unit
            signal = csv_signal(folder / table.csv, table.column or name, table.between, unit)
        else:
            signal = constant(table.constant or 0.0)
        for value in signal.values:
            VARIABLES[name].read(value)
        return signal
