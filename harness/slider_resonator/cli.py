"""The command line: exit code 0 (pass), 1 (fail), 2 (could not run) or 130 (interrupted)."""

import importlib
import os
import signal
import sys
import traceback
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from io import StringIO
from itertools import pairwise
from typing import Any, NoReturn

import click

from slider_resonator import __version__
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.fmu.limits import DEFAULTS, MEMORY, UNPACKED
from slider_resonator.output.console import exit_with, open_closed_streams, print_text
from slider_resonator.output.json_output import to_json
from slider_resonator.output.readable import escaped, indented

COULD_NOT_RUN = 2
INTERRUPTED = 130
"""The exit code that shells report for a process ended by SIGINT."""
COMMANDS: Mapping[str, str] = {
    "baseline": "Compare an FMU with its own earlier results.",
    "blocking": "Find the load that stops an FMU, without a long run.",
    "choose": "Choose the cheapest model that meets a scene's needs.",
    "device": "Say what a device file means; devices to start from.",
    "fit": "Estimate parameters of a device from measurements.",
    "page": "Write a page that runs the component in a browser.",
    "run": "Run one scene and report results and cost.",
    "scenes": "List the built-in scenes; help to write your own.",
    "steady": "Find the steady velocity of an FMU, without a long run.",
    "stress": "Run FMUs at extremes and with random devices.",
    "sweep": "Compute measures over a grid of parameters and inputs.",
    "trade": "Measure error and cost of every model and peer method.",
    "validate": "Compare FMUs with the references, scene by scene.",
}
"""Name to summary of what is installed."""
ELSEWHERE: Mapping[str, str] = {"blocking": "steady"}
"""Commands that are in the module of another."""
RENAMED: Mapping[str, tuple[Sequence[str], Mapping[str, str]]] = {
    "campaign": (("stress", "--random", "1000"), {"--cases": "--random"}),
    "extremes": (("stress",), {"--cell": "--case", "--limit": "--time-limit"}),
}
"""Old names of commands: the words in their place, and of their options that have other names."""


_WHOLE = "\N{NON-BREAKING HYPHEN}"
"""Stands for a hyphen while click wraps: it would split names there."""


class WholeNames(click.HelpFormatter):
    """A help formatter that splits no name at its hyphens."""

    def write(self, string: str) -> None:
        """Write what is wrapped."""
        super().write(string.replace(_WHOLE, "-"))

    def write_text(self, text: str) -> None:
        """Write a text."""
        super().write_text(text.replace("-", _WHOLE))

    def write_dl(
        self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2
    ) -> None:
        """Write a list of names with their texts."""
        whole = [(name, text.replace("-", _WHOLE)) for name, text in rows]
        super().write_dl(whole, col_max, col_spacing)


click.Context.formatter_class = WholeNames
"""Of every command: click takes it from the class."""


class HarnessGroup(click.Group):
    """A group of commands in which exit code 1 always means a failed verdict.

    Python and click exit with 1 on some errors too. A command returns its exit code, or None for 0.
    It is loaded when it is called: loading all takes longer than running most.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.packages: dict[str, str] = {}
        self.summaries: dict[str, str] = {}
        self.add_package("slider_resonator.commands", COMMANDS)

    def add_package(self, package: str, summaries: Mapping[str, str]) -> None:
        """Add commands, by name and summary.

        Each is `<name>_command` in the module `<package>.<name>`, with _ for -, or `ELSEWHERE`.
        """
        self.packages |= dict.fromkeys(summaries, package)
        self.summaries = dict(sorted((self.summaries | dict(summaries)).items()))

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return all names, in the order of the help."""
        return list(self.summaries)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Load a command; return None for an unknown name."""
        if cmd_name not in self.summaries:
            return None
        name = cmd_name.replace("-", "_")
        file = ELSEWHERE.get(cmd_name, name)
        module = importlib.import_module(f"{self.packages[cmd_name]}.{file}")
        command: click.Command = getattr(module, f"{name}_command")
        command.short_help = self.summaries[cmd_name]
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return a command, which an old name may call, with its name and arguments."""
        if args[0] in RENAMED:
            words, options = RENAMED[args[0]]
            print_text(f"note: {args[0]} is now {' '.join(words)}", err=True)
            parts = (one.partition("=") for one in args[1:])
            rest = [options.get(name, name) + sign + value for name, sign, value in parts]
            args = [*words, *rest]
        if args[0] not in self.summaries and not args[0].startswith("-"):
            ctx.fail(unknown_name("command", args[0], self.summaries))
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write names and summaries without loading the commands."""
        with formatter.section("Commands"):
            formatter.write_dl(list(self.summaries.items()))

    def main(self, args: Sequence[str] | None = None, *others: Any, **extra: Any) -> NoReturn:
        """Run a command and exit with its code; with --json report an error as JSON too."""
        arguments = list(sys.argv[1:] if args is None else args)
        open_closed_streams()
        if args is None:
            os.environ["MPLBACKEND"] = "agg"  # that of a notebook need not be installed here
            # As for Ctrl-C: the processes of FMUs must be ended and temporary files removed.
            signal.signal(signal.SIGTERM, signal.default_int_handler)
        try:
            code = super().main(arguments, *others, **{**extra, "standalone_mode": False})
        except SystemExit as end:  # click and rich exit with 1 when their output is a closed pipe
            exit_with(COULD_NOT_RUN if end.code else 0)
        except Exception as error:
            # click raises Abort from a KeyboardInterrupt, but also from an EOFError.
            cause = error.__cause__ or error if isinstance(error, click.Abort) else error
            with suppress(OSError):
                message = _report(cause)
                pairs = pairwise([*arguments, ""])  # --json may have a file
                if any(one == "--json" and not after.endswith(".json") for one, after in pairs):
                    click.echo(to_json({"error": message}))
            exit_with(INTERRUPTED if isinstance(cause, KeyboardInterrupt) else COULD_NOT_RUN)
        exit_with(code if isinstance(code, int) else 0)


def _report(error: BaseException) -> str:
    """Print the error message on stderr and return it."""
    if isinstance(error, click.ClickException):
        shown = StringIO()
        error.show(shown)
        print_text(shown.getvalue().rstrip("\n"), err=True)
        return error.format_message()
    if isinstance(error, KeyboardInterrupt):
        message = "\n".join(["interrupted", *getattr(error, "__notes__", [])])
    elif isinstance(error, HarnessError):
        message = f"error: {error}"
    elif isinstance(error, OSError):
        reason = error.strerror or str(error) or type(error).__name__
        message = f"error: {error.filename or 'standard output'}: {reason}"
    else:
        click.echo(escaped("".join(traceback.format_exception(error))), err=True, nl=False)
        return f"internal error: {error!r}"
    print_text(indented(message), err=True)
    return message.removeprefix("error: ")


@click.group(
    cls=HarnessGroup, context_settings={"help_option_names": ["-h", "--help"], "show_default": True}
)
@click.version_option(__version__, prog_name="slider-resonator")
@click.option(
    "--max-memory",
    type=click.IntRange(min=1),
    metavar="MIB",
    help=f"Memory of an FMU and all that it starts, on Linux.  [default: {DEFAULTS[MEMORY]}]",
)
@click.option(
    "--max-unpacked",
    type=click.IntRange(min=1),
    metavar="MIB",
    help=f"Size of the unpacked files of an FMU.  [default: {DEFAULTS[UNPACKED]}]",
)
def main(max_memory: int | None, max_unpacked: int | None) -> None:
    """Run a slider-resonator FMU and report with numbers whether it is right.

    Exit code of every command: 0 (pass), 1 (fail), 2 (could not run), 130 (interrupted). An FMU
    runs in a process and a folder of its own, which end with the command. The options before the
    command can be set in the environment as SLIDER_RESONATOR_MAX_MEMORY and ..._MAX_UNPACKED.

    \b
    Examples:
      slider-resonator validate
      slider-resonator run my.fmu table_1 --out table_1.csv --plot table_1.png
      slider-resonator steady my.fmu --set phase=0.4 --set load=0.05 --json
      slider-resonator sweep grid.toml --out table.parquet
    """
    for variable, value in ((MEMORY, max_memory), (UNPACKED, max_unpacked)):
        if value is not None:
            os.environ[variable] = str(value)  # which the processes of FMUs inherit
