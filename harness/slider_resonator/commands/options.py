"""Arguments and options that several commands share."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial, wraps
from pathlib import Path
from typing import Any, TypeVar

import click

from slider_resonator.device.interface import SETTABLE, VARIABLES, settable_value
from slider_resonator.device.units import is_number, positive_time
from slider_resonator.errors import HarnessError, SceneError
from slider_resonator.fmu import finished
from slider_resonator.fmu.isolation.tasks import available_cores
from slider_resonator.output.console import print_text
from slider_resonator.output.files import writable
from slider_resonator.scenes import device_file
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import FIRST, built_in_scenes, find_scene
from slider_resonator.scenes.toml_file import read_toml

SET = "--set"
Value = TypeVar("Value")
FC = TypeVar("FC", bound=Callable[..., Any])
"""A command, or the function that becomes one."""
_SETTING = re.compile(r"[A-Za-z_]\w*=")


class Parsed(click.ParamType[Value]):
    """What `read`, which raises ValueError or HarnessError, makes of the parts of a text.

    The parts are the groups of `pattern`, by default the whole text. The help shows `name`, a
    message an `example` of it, too.
    """

    def __init__(
        self, name: str, read: Callable[..., Value], pattern: str = "(.*)", example: str = ""
    ) -> None:
        self.name = name
        self.read = read
        self.pattern = re.compile(pattern, re.DOTALL)
        self.example = example

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> Value:
        """Return what is read, or fail with the message of the error."""
        parts = self.pattern.fullmatch(value)
        if parts is None:
            self.fail(f"{value!r} is not {self.name}, such as {self.example}", param, ctx)
        try:
            return self.read(*parts.groups())
        except (ValueError, HarnessError) as error:
            self.fail(str(error), param, ctx)


DURATION = Parsed("TIME", positive_time)
"""A time above 0, in s or with a unit."""
stop_time_option = click.option(
    "--time",
    "stop_time",
    type=DURATION,
    help="How long to run, in s or with a unit, in place of what the scene says.",
)


def step_option(what: str) -> Callable[[FC], FC]:
    """Return --step, a size of steps; `what` is its meaning."""
    said = f"{what}, in s or with a unit, in place of what the scene says."
    return click.option("--step", "step_size", type=DURATION, help=said)


def target(suffixes: Sequence[str]) -> Parsed[Path]:
    """Return a file to write, checked before anything runs; `suffixes` are the allowed ones."""
    return Parsed("FILE", partial(writable, suffixes=suffixes))


def setting(name: str, number: str) -> tuple[str, float]:
    """Return name and value of a parameter or input of the FMU; ValueError if wrong."""
    name = name.strip()
    value = settable_value(name, number)
    if is_number(number):
        note(device_file.possible_slips({name: value}))
    return name, value


def note(sentences: Sequence[str], source: str = "") -> None:
    """Print notes, such as what may be meant in another unit in a file or option."""
    for sentence in sentences:
        print_text(f"note: {source}: {sentence}" if source else f"note: {sentence}", err=True)


@dataclass(frozen=True)
class Given:
    """What --device and --set say: a device file or None, and parameters and inputs."""

    device: device_file.DeviceFile | None
    settings: Mapping[str, float]

    @property
    def values(self) -> dict[str, float]:
        """The values of both; where both set one, that of --set."""
        return {**(self.device.values if self.device else {}), **self.settings}

    @property
    def sources(self) -> dict[str, Path]:
        """The device file, which no result may replace, by what it is."""
        return {"the device": self.device.path} if self.device else {}

    def scene(self, name: str) -> Scene:
        """Return the scene of a name or file with the values; note its slips.

        Only those of a scene of the user's own: those of a device file are noted as it is read.
        """
        scene = find_scene(name, self.settings, self.device)
        if self.device is None and name not in built_in_scenes():
            note(scene.slips, scene.source)
        return scene

    def check_left_to_choose(self) -> None:
        """Raise UsageError for a fidelity or tolerance, which are to be chosen."""
        given = [f"{n} = {self.values[n]:g}" for n in ("fidelity", "tolerance") if n in self.values]
        if given:
            raise click.UsageError(
                f"'--set': {', '.join(given)}: it is chosen; must be another parameter or input"
            )


class SettingsCommand(click.Command):
    """A command with `--set`, after which several NAME=VALUE may follow."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Insert `--set` before each further NAME=VALUE."""
        return super().parse_args(ctx, _each_with_its_option(args))


def _each_with_its_option(arguments: Sequence[str]) -> list[str]:
    spread: list[str] = []
    inside = False
    for before, argument in zip(["", *arguments], arguments, strict=False):
        if inside and _is_unit_of(before, argument):
            raise click.UsageError(
                f"{before} {argument}: must be in quotes, as {SET} '{before} {argument}'"
            )
        bare = inside and before != SET and _SETTING.match(argument) is not None
        if bare:
            spread.append(SET)
        spread.append(argument)
        inside = bare or before == SET or argument == SET or argument.startswith(f"{SET}=")
    return spread


def _is_unit_of(setting_before: str, argument: str) -> bool:
    """Whether an argument is the unit of the setting before, such as deg after phase=30."""
    name, _, number = setting_before.partition("=")
    if name not in SETTABLE or not is_number(number) or Path(argument).exists():
        return False
    try:
        VARIABLES[name].in_si(f"{number} {argument}")
    except ValueError:
        return False
    return True


def each_once(
    context: click.Context, option: click.Parameter, settings: Sequence[tuple[str, Value]]
) -> dict[str, Value]:
    """Return repeated NAME=VALUE as a dictionary; BadParameter for a name that is given twice."""
    given: dict[str, Value] = {}
    for name, value in settings:
        if name in given:
            raise click.BadParameter(f"{name} is given twice; must be once", context, option)
        given[name] = value
    return given


def _no_toml(kind: str, text: str) -> Path:
    """Return the path of a file of a kind.

    Raises SceneError for a scene, grid, device or setting in its place.
    """
    path = Path(text)
    if text.partition("=")[0] in SETTABLE and not path.exists():
        raise SceneError(f"{text}: no such file; must be a file, or --set {text}")
    if path.suffix == ".toml" and path.is_file():
        device_file.refuse_other_kinds(read_toml(path), text, kind)
    return path


FMU_FILE = Parsed("path", partial(_no_toml, "FMU"))
DATA_FILE = Parsed("path", partial(_no_toml, "CSV"))
"""Files in whose place a file of another kind is named as what it is."""


def default_fmus() -> tuple[Path, ...]:
    """Return the FMUs built in the folder `dist` here, or else finished ones, the native one first.

    Raises FmuError, with the remedy, when there is none.
    """
    names = (finished.FMUS["native"], finished.FMUS["python"])
    for folder in finished.COMMANDS_LOOK_IN:
        found = tuple(folder / name for name in names if (folder / name).is_file())
        if found:
            return found
    return (finished.fmu_path("native"),)


def default_fmu(given: Path | None) -> Path:
    """Return the given FMU, or the first of `default_fmus`, which raises FmuError."""
    return given if given is not None else default_fmus()[0]


def fmu_argument(
    command: Callable[..., Any],
    default: str = "the native one, in dist or installed",
    chosen: Callable[[Path | None], Path | None] = default_fmu,
) -> Callable[..., Any]:
    """Add an FMU as an argument or as the option --fmu; the command gets it as `fmu`.

    Without one the command gets what is `chosen`; `default` is the text about that.
    """

    @click.argument("fmu", type=click.Path(path_type=Path), required=False)
    @click.option(
        "--fmu",
        "given",
        type=FMU_FILE,
        help=f"The FMU, instead of as an argument.  [default: {default}]",
    )
    @wraps(command)
    def with_fmu(fmu: Path | None, given: Path | None, **others: Any) -> Any:
        if others.get("scene", "") is None:  # the one argument, if any, is the FMU or the scene
            others["scene"] = FIRST
            if fmu is not None and fmu.suffix != ".fmu":
                find_scene(str(fmu))  # a wrong name comes before a default FMU not built
                fmu, others["scene"] = None, str(fmu)
        fmu = fmu and _no_toml("FMU", str(fmu))
        if fmu is not None and given is not None:
            raise click.UsageError(f"{fmu} and --fmu {given}: must be one FMU")
        return command(fmu=chosen(fmu or given), **others)

    return with_fmu


def fmus_argument(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add any number of FMUs as arguments or as options --fmu; the command gets them as `fmus`."""

    @click.argument("fmus", type=FMU_FILE, nargs=-1)
    @click.option(
        "--fmu",
        "given",
        type=FMU_FILE,
        multiple=True,
        help="An FMU, instead of as an argument. Repeatable.",
    )
    @wraps(command)
    def with_fmus(fmus: tuple[Path, ...], given: tuple[Path, ...], **others: Any) -> Any:
        return command(fmus=fmus + given, **others)

    return with_fmus


jobs_option = click.option(
    "--jobs",
    "--workers",
    "jobs",
    type=click.IntRange(min=1),
    callback=lambda _, __, jobs: jobs or available_cores(),
    help="Processes.  [default: one per core]",
)

fmu_option = click.option(
    "--fmu",
    type=FMU_FILE,
    callback=lambda _, __, fmu: default_fmu(fmu),
    help="FMU to run.  [default: the native one, in dist or installed]",
)


def read_device(name_or_file: str) -> device_file.DeviceFile:
    """Return a device file or an example; note slips.

    Raises SceneError as `read_device_file` does.
    """
    read = device_file.read_device_file(name_or_file)
    note([*read.slips, *device_file.without_drive(read.values)], name_or_file)
    return read


device_option = click.option(
    "--device",
    metavar="NAME|FILE",
    help="A device file, or an example of `slider-resonator device`.  [default: table 1]",
)


def device_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add --device and --set: the command gets what they say as `given`."""

    @device_option
    @click.option(
        SET,
        "settings",
        type=Parsed("NAME=VALUE", setting, "(.*?)=(.*)", "phase=0.4"),
        multiple=True,
        callback=each_once,
        help="Set a parameter or input, in SI units or with a unit, as 'load=50 mN'; more "
        "NAME=VALUE may follow. All others keep the value of the device. Repeatable.",
    )
    @wraps(command)
    def with_device(device: str | None, settings: dict[str, float], **others: Any) -> Any:
        read = None if device is None else read_device(device)
        return command(given=Given(read, settings), **others)

    return with_device


json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")


def out_folder_option(contents: str, *, required: bool = True) -> Callable[[FC], FC]:
    """Return the option --out, a folder; `contents` is the help text about what goes into it."""
    return click.option(
        "--out",
        type=click.Path(path_type=Path, file_okay=False),
        required=required,
        help=f"Folder for {contents}.",
    )


def scenes_option(default: str) -> Callable[[FC], FC]:
    """Return the repeatable option --scene; `default` is the help text about its default."""
    return click.option(
        "--scene",
        "scenes",
        multiple=True,
        metavar="NAME|FILE|DIR",
        help="A built-in scene, a scene file or a folder of scene files. Repeatable.  "
        f"[default: {default}]",
    )


def time_limit_option(default: float, help_text: str) -> Callable[[FC], FC]:
    """Return the option --time-limit (s)."""
    return click.option(
        "--time-limit",
        type=click.FloatRange(min=0.0, min_open=True),
        default=default,
        metavar="SECONDS",
        help=help_text,
    )
