"""Arguments and options that several commands share."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from harness.errors import FmuError, HarnessError
from harness.interface import INPUTS, PARAMETERS
from harness.names import unknown_name
from harness.targets import writable
from harness.values import check_value

BUILT_FMU = Path("dist") / "SliderResonatorPy.fmu"
REPOSITORY = Path(__file__).resolve().parents[2]


class Setting(click.ParamType[tuple[str, float]]):
    """NAME=VALUE with a parameter or input of the FMU."""

    name = "NAME=VALUE"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, float]:
        """Split, check the name, and read and check the number."""
        if isinstance(value, tuple):
            return value
        name, separator, number = str(value).partition("=")
        name = name.strip()
        if not separator:
            self.fail(f"{value!r} is not NAME=VALUE, such as phase=0.4", param, ctx)
        allowed = [*PARAMETERS, *INPUTS]
        if name not in allowed:
            self.fail(unknown_name("parameter or input", name, allowed), param, ctx)
        try:
            read = float(number)
        except ValueError:
            self.fail(f"{name} = {number!r}: allowed is a number", param, ctx)
        try:
            check_value(name, read)
        except ValueError as error:
            self.fail(str(error), param, ctx)
        return name, read


class Target(click.ParamType[Path]):
    """A file to write, judged before anything is run; `suffixes`, if any, are those allowed."""

    name = "FILE"

    def __init__(self, suffixes: Sequence[str] = ()) -> None:
        self.suffixes = suffixes

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> Path:
        """Return the path, or say why it cannot be written."""
        try:
            return writable(str(value), self.suffixes)
        except HarnessError as error:
            self.fail(str(error), param, ctx)


def _each_once(
    context: click.Context, option: click.Parameter, settings: Sequence[tuple[str, float]]
) -> dict[str, float]:
    given: dict[str, float] = {}
    for name, value in settings:
        if name in given:
            raise click.BadParameter(
                f"{name} = {given[name]!r} and {name} = {value!r}: allowed is one value",
                context,
                option,
            )
        given[name] = value
    return given


fmu_argument = click.argument("fmu", type=click.Path(path_type=Path))

set_option = click.option(
    "--set",
    "settings",
    type=Setting(),
    multiple=True,
    callback=_each_once,
    help="Value of a parameter or input, in SI units; may be given several times. All others keep "
    "their start value, the device of table 1.",
)

json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")

max_denominator_option = click.option(
    "--max-denominator",
    type=click.IntRange(min=1),
    default=20,
    show_default=True,
    help="Largest q for which a frequency ratio p/q counts as having a common period.",
)


def default_fmu(given: Path | None) -> Path:
    """Return the FMU that was asked for, or the one that was built here or in the repository.

    Raises FmuError, with the command that builds it, where there is none.
    """
    if given is not None:
        return given
    for folder in (Path(), REPOSITORY):
        if (folder / BUILT_FMU).is_file():
            return folder / BUILT_FMU
    raise FmuError(f"{BUILT_FMU}: no such file; build it with: python build_fmu.py")
