"""What the commands do, for scripts: run an FMU, search it, judge it, choose a model, sweep.

    import slider_resonator as sr

    with sr.open_fmu() as fmu:
        record = fmu.run({"run": {"stop_time": 4.0, "step_size": 0.01}}, phase=0.4, load=0.05)
        print(record.final("mean_velocity"), fmu.steady(phase=0.4, load=0.05).steady_velocity)

Keywords are parameters and inputs of the FMU, numbers in SI units or texts such as "20 kHz"; all
others keep the value of the device, by default that of table 1. A device is a `Device`, a device
file, the name of an example of `slider-resonator device`, or its parameters by name. A scene is the
name of one that is built in, a file, data of the same form, or the result of `read_scene`. Data may
have numpy arrays and ranges for lists. Without an FMU the native one of this installation is used.
Every error is a `HarnessError`, whose text is what the command would print; arguments of another
type than stated may raise a `TypeError`. A number that may be meant in another unit is warned of.

The `repr` of a result says what was found, on a screen at most. `to_pandas()` gives its table and
`plot()` its picture, where it has one.
"""

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from slider_resonator.arguments import (
    DeviceLike,
    SceneLike,
    Value,
    check_kind,
    check_positive,
    fmu_of,
    fmus_of,
    parameters_of,
    plain,
    read_scene,
    scene_of,
    values_of,
)
from slider_resonator.checks.validate import Validation
from slider_resonator.checks.validate import validate as validate_scenes
from slider_resonator.choosing.choice import Choice
from slider_resonator.choosing.choosing import choose as choose_model
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import MAX_DENOMINATOR
from slider_resonator.device.units import positive_time
from slider_resonator.errors import HarnessError, SceneError, explained
from slider_resonator.fitting.fit import STARTS, isolated
from slider_resonator.fitting.fit import fit as fit_parameters
from slider_resonator.fitting.measurements import Measurements
from slider_resonator.fitting.reading import measurements_of
from slider_resonator.fitting.result import Fit
from slider_resonator.fmu.finished import fmu_path
from slider_resonator.fmu.isolation.process import TIME_LIMIT, IsolatedFmu
from slider_resonator.fmu.isolation.tasks import available_cores
from slider_resonator.fmu.run import Record
from slider_resonator.fmu.run import run as run_schedule
from slider_resonator.output.shown import Drawable
from slider_resonator.scenes.device_file import to_toml as device_text
from slider_resonator.scenes.needs import allowed_error
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import find_scenes
from slider_resonator.steady.searches import (
    Blocking,
    SteadyMotion,
    find_blocking,
    find_steady,
    refuse_load,
)
from slider_resonator.stressing.axes import axis_cases, device_cases
from slider_resonator.stressing.random_cases import random_case
from slider_resonator.stressing.run import TIME_LIMIT as CASE_LIMIT
from slider_resonator.stressing.run import StressResult, run_cases
from slider_resonator.sweeping.grid import grid_from, read_grid
from slider_resonator.sweeping.sweeping import SweepResult, run_sweep
from slider_resonator.trading.measure import BUDGET, REPEATS, measure_trade, opened
from slider_resonator.trading.measure import TIME_LIMIT as TRADE_LIMIT
from slider_resonator.trading.problem import problem_of
from slider_resonator.trading.result import Trade

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Blocking", "Choice", "Device", "Fit", "HarnessError", "OpenFmu", "Record", "Scene"]
__all__ += ["SteadyMotion", "StressResult", "SweepResult", "Trade", "Validation"]
__all__ += ["choose", "fit", "fmu_path", "open_fmu", "read_device", "read_scene", "stress"]
__all__ += ["sweep", "to_toml", "trade", "validate"]


@dataclass(frozen=True, repr=False)
class SceneRecord(Record, Drawable):
    """The record of a run of `scene`."""

    scene: Scene

    def figure(self) -> "Figure":
        """Draw position and mean velocity over time, and inputs that vary.

        Where the communication points resolve them, the last drive periods follow in full.
        """
        # Imported here: drawing takes longer to load than most scenes to run.
        from slider_resonator.scenes.run_plots import run_figure

        return run_figure(self, self.scene)


class OpenFmu(AbstractContextManager["OpenFmu"]):
    """An FMU that runs in a process of its own: it may crash or hang and the script goes on.

    Use it in a `with` block, or `close` it. What it computes is for `device` unless values say
    else. Every method may take the `time_limit` (s), and raises HarnessError where the FMU refuses,
    crashes or exceeds that.
    """

    def __init__(
        self,
        fmu: str | Path | None = None,
        *,
        device: DeviceLike | None = None,
        time_limit: float = TIME_LIMIT,
    ) -> None:
        check_positive(time_limit=time_limit)
        self.path = fmu_of(fmu)
        self._device = parameters_of(device)
        self._isolated = IsolatedFmu(self.path, time_limit)

    def __exit__(self, kind: type[BaseException] | None, error: Any, trace: Any) -> None:
        """Free the FMU and end its process."""
        self._isolated.__exit__(kind, error, trace)

    def close(self) -> None:
        """Free the FMU and end its process."""
        self._isolated.close()

    def run(self, scene: SceneLike, **values: Value) -> SceneRecord:
        """Run a scene and return inputs and outputs at all its communication points.

        The device that the FMU was opened with takes the place of the scene's, as in
        `Scene.with_device`.
        """
        read = scene_of(scene, self._device, values)
        task = partial(run_schedule, parameters=read.parameters, schedule=read.schedule())
        record: Record = self._isolated.run(task)
        return SceneRecord(**vars(record), scene=read)

    def steady(self, *, max_denominator: int = MAX_DENOMINATOR, **values: Value) -> SteadyMotion:
        """Find the steady motion by shooting; its `status` says why there is none."""
        motion: SteadyMotion = self._search(find_steady, max_denominator, values)
        return motion

    def blocking(self, *, max_denominator: int = MAX_DENOMINATOR, **values: Value) -> Blocking:
        """Find the load that stops the slider; its `status` says why there is none."""
        refuse_load(values)
        blocking: Blocking = self._search(find_blocking, max_denominator, values)
        return blocking

    def _search(self, find: Any, max_denominator: int, values: Mapping[str, Value]) -> Any:
        check_positive(max_denominator=max_denominator)
        checked = {**self._device, **values_of(values)}
        return self._isolated.run(partial(find, values=checked, max_denominator=max_denominator))


open_fmu = OpenFmu
"""Open an FMU for a `with` block."""


def read_device(device: DeviceLike) -> Device:
    """Return a device: of a file, of an example by name, of parameters, or as it is.

    Raises SceneError with file, key, value and requirement.
    """
    return Device.from_mapping(parameters_of(device))


def to_toml(device: DeviceLike, title: str = "") -> str:
    """Return the text of a device file: what differs from table 1, and the number of faces.

    Raises SceneError as `read_device` does.
    """
    return device_text(read_device(device), title)


def validate(
    *fmus: str | Path,
    scenes: SceneLike | Sequence[SceneLike] | None = None,
    time_limit: float = TIME_LIMIT,
    jobs: int | None = None,
) -> tuple[Validation, ...]:
    """Compare FMUs with the references.

    `scenes` is a name, a file, a folder or a scene as data, or several of these, by default all
    that are built in. `time_limit` (s) is that of each point of a scene. `jobs` processes compute
    the references and as many at most run an FMU, by default one for each core. Raises SceneError
    where `scenes` is empty.
    """
    given = scenes if isinstance(scenes, Sequence) and not isinstance(scenes, str) else [scenes]
    if not given:
        raise SceneError("scenes = []: must be at least one scene; leave it out to run all")
    named = [str(scene) for scene in given if isinstance(scene, str | Path)]
    found = find_scenes(named) if named or scenes is None else []
    found += [read_scene(s) for s in given if s is not None and not isinstance(s, str | Path)]
    check_positive(time_limit=time_limit, jobs=jobs)
    processes = jobs or available_cores()
    return validate_scenes(fmus_of(fmus), found, time_limit=time_limit, jobs=processes)


def choose(
    scene: SceneLike = "table_1",
    fmu: str | Path | None = None,
    *,
    device: DeviceLike | None = None,
    need: Mapping[str, Value] | None = None,
    time: Value | None = None,
    step: Value | None = None,
    **values: Value,
) -> Choice:
    """Choose the cheapest fidelity, friction law, tolerance and step that meet a scene's needs.

    `need` has the allowed errors of quantities, such as `{"position": "2 um", "velocity": "1 %"}`,
    in place of the scene's, `time` (s) is that of the run, `step` (s) between samples of signals.
    A `device` takes the place of the scene's, as in `OpenFmu.run`.
    """
    check_kind(Mapping, "errors by quantity", need=need)
    read = scene_of(scene, parameters_of(device), values)
    with explained():
        spans = [one if one is None else positive_time(str(one)) for one in (time, step)]
        read = read.timed(stop_time=spans[0], step_size=spans[1])
        if need:
            read = read.needing({name: allowed_error(name, str(e)) for name, e in need.items()})
    return choose_model(read, fmu_of(fmu))


def sweep(
    grid: str | Path | Mapping[str, Any],
    out: str | Path,
    fmu: str | Path | None = None,
    *,
    device: DeviceLike | None = None,
    workers: int | None = None,
    restart: bool = False,
    overwrite: bool = False,
) -> SweepResult:
    """Compute measures over a grid and write the table `out` (CSV or Parquet).

    `grid` is a file or data of the same form; `device` has the parameters that it leaves out.
    `workers` is the number of processes, by default one for each core. `columns` of the result are
    the table. Finished points are kept beside `out` until it is written; `restart` discards them. A
    table that exists is replaced only with `overwrite`.
    """
    check_positive(workers=workers)
    count = workers or available_cores()
    stated = parameters_of(device)
    if isinstance(grid, Mapping):
        read = grid_from(plain(grid), "grid", stated)
    else:
        read = read_grid(Path(grid), stated)
    return run_sweep(
        read, fmu_of(fmu), Path(out), workers=count, restart=restart, overwrite=overwrite
    )


def fit(
    data: str | Path | Mapping[str, Any] | Measurements | Sequence[str | Path] | Any,
    free: str | Sequence[str],
    fmu: str | Path | None = None,
    *,
    device: DeviceLike | None = None,
    bounds: Mapping[str, tuple[Value, Value]] | None = None,
    starts: int = STARTS,
    jobs: int | None = None,
    time_limit: float = TIME_LIMIT,
    **values: Value,
) -> Fit:
    """Estimate the parameters `free` of a device from measurements, with 95 % intervals.

    `data` is a CSV file, as `slider-resonator fit --help` describes, columns of numbers by heading,
    such as `{"phase [deg]": ..., "velocity [mm/s]": ...}`, a DataFrame, or several of these.
    `values` are parameters and inputs that are not in the data. The result has `parameters`, and
    the `device` to go on with.
    """
    check_positive(starts=starts, jobs=jobs, time_limit=time_limit)
    check_kind(Sequence, "names of parameters", free=free)
    check_kind(Mapping, "lowest and highest value by name", bounds=bounds)
    measurements = measurements_of(data)
    names = [free] if isinstance(free, str) else free
    settings = values_of(values)
    measurements.refuse_known(settings)
    checked = {**parameters_of(device), **settings}
    with isolated(fmu_of(fmu), jobs or available_cores(), time_limit) as run:
        return fit_parameters(
            measurements, names, checked, run, bounds=plain(bounds), starts=starts
        )


def stress(
    *fmus: str | Path,
    random: int | None = None,
    seed: int = 1,
    device: DeviceLike | None = None,
    jobs: int | None = None,
    time_limit: float = CASE_LIMIT,
) -> tuple[StressResult, ...]:
    """Run FMUs at the extremes of everything, or with random devices, and judge them by physics.

    The cases are those of the axes, or `random` devices drawn from `seed`, or several inputs and
    steps of `device`. A case that exceeds the `time_limit` (s) fails.
    """
    check_positive(random=random, jobs=jobs, time_limit=time_limit)
    if random is not None and device is not None:
        raise HarnessError(f"random = {random!r} and device = {device!r}: must be only one")
    if device is not None:
        name = str(device) if isinstance(device, str | Path) else "mine"
        cases = device_cases(name, parameters_of(device))
    elif random is not None:
        cases = [random_case(seed, number) for number in range(random)]
    else:
        cases = axis_cases()
    run = partial(run_cases, cases=cases, time_limit=time_limit, jobs=jobs or available_cores())
    return tuple(run(fmu) for fmu in fmus_of(fmus))


def trade(
    scene: SceneLike,
    *fmus: str | Path,
    device: DeviceLike | None = None,
    periods: int | None = None,
    repeats: int = REPEATS,
    budget: float = BUDGET,
    time_limit: float = TRADE_LIMIT,
    **values: Value,
) -> tuple[Trade, ...]:
    """Measure error and cost of every model of the FMUs and of other methods on a scene.

    The result has an entry for each point of the scene's sweep. Runs are cut to `periods` drive
    periods; each method is repeated `repeats` times, or as often as the `budget` (s of CPU time)
    allows. The peer that needs heyoka is left out without it.
    """
    check_positive(periods=periods, repeats=repeats, budget=budget, time_limit=time_limit)
    read = scene_of(scene, parameters_of(device), values)
    problems = [problem_of(point.scene, point.at, periods) for point in read.points()]
    with opened(fmus_of(fmus), time_limit) as instances:
        measured = partial(measure_trade, instances=instances, repeats=repeats, budget=budget)
        return tuple(map(measured, problems))
