"""The commands that search by shooting."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import click

from slider_resonator.commands import options
from slider_resonator.commands.results import print_result
from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUT_STARTS, VARIABLES
from slider_resonator.fmu.isolation.process import TIME_LIMIT, IsolatedFmu
from slider_resonator.fmu.provenance import provenance_of
from slider_resonator.output.progress_bar import progress_bar
from slider_resonator.output.readable import number_of, one_line
from slider_resonator.steady.search_result import SearchResult


def search_command(
    name: str, what: str, find: Callable[..., SearchResult], help_text: str
) -> click.Command:
    """Return the command that searches something of an FMU by shooting."""

    @click.command(name, cls=options.SettingsCommand, help=help_text)
    @options.native_fmu_argument
    @options.set_option
    @options.max_denominator_option
    @options.time_limit_option(TIME_LIMIT, "For the whole search.")
    @options.json_option
    @click.pass_context
    def command(
        context: click.Context,
        fmu: Path,
        settings: dict[str, float],
        max_denominator: int,
        time_limit: float,
        as_json: bool,
    ) -> None:
        provenance = provenance_of(fmu)
        search = partial(find, values=settings, max_denominator=max_denominator)
        with progress_bar() as progress, IsolatedFmu(fmu, time_limit) as isolated:
            progress(f"searching the {what}", 0.0)
            result: SearchResult = isolated.run(search, progress)
        faces = int(settings.get("friction_faces", Device().friction_faces))
        inputs = (
            f"{name} {settings.get(name, start):g} {VARIABLES[name].unit}".removesuffix(" 1")
            for name, start in INPUT_STARTS.items()
            if (name, what) != ("load", "blocking force")
        )
        lines = [
            *result.describe(),
            f"inputs           {', '.join(inputs)}",
            f"friction         on {number_of(faces, 'face')} (friction_faces)",
            f"FMU              {one_line(str(fmu))}",
        ]
        print_result(result, "\n".join(lines), as_json=as_json, provenance=provenance)
        context.exit(1 if result.answer[1] is None else 0)

    return command
