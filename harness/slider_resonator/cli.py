"""The command line: every command ends with 0 (pass), 1 (fail) or 2 (could not run)."""

from __future__ import annotations

import importlib
import signal
import sys
import traceback
from collections.abc import Sequence
from contextlib import suppress
from typing import Any, NoReturn

import click

from slider_resonator import __version__
from slider_resonator.errors import HarnessError
from slider_resonator.output.console import leave
from slider_resonator.output.json_output import to_json

COULD_NOT_RUN = 2
COMMANDS = (
    "baseline",
    "bench",
    "blocking",
    "choose",
    "closed-loop",
    "crosscheck",
    "extremes",
    "hosts",
    "mutants",
    "paper",
    "picture",
    "run",
    "scenes",
    "steady",
    "sweep",
    "trade",
    "validate",
)
"""Each is `<name>_command` in `slider_resonator.commands.<name>`, with _ for -.

A command is loaded when it is called: all together take longer to load than most take to run."""


class HarnessGroup(click.Group):
    """A group of commands that never lets an error pass for a verdict.

    Python and click end with 1 on some errors; here 1 means that something was judged and failed.
    """

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return all names, in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Load a command; None for a name that there is not."""
        if cmd_name not in COMMANDS:
            return None
        name = cmd_name.replace("-", "_")
        module = importlib.import_module(f"slider_resonator.commands.{name}")
        command: click.Command = getattr(module, f"{name}_command")
        return command

    def main(
        self,
        args: Sequence[str] | None = None,
        prog_name: str | None = None,
        complete_var: str | None = None,
        standalone_mode: bool = True,
        **extra: Any,
    ) -> NoReturn:
        """Run a command and leave with its exit code; with --json an error is JSON too."""
        arguments = list(sys.argv[1:] if args is None else args)
        if args is None:
            # As for Ctrl-C: the processes of FMUs must be ended and temporary files removed.
            signal.signal(signal.SIGTERM, signal.default_int_handler)
        try:
            code = super().main(arguments, prog_name, complete_var, standalone_mode=False, **extra)
        except SystemExit as end:  # click and rich leave with 1 when nobody reads their output
            leave(COULD_NOT_RUN if end.code else 0)
        except Exception as error:
            with suppress(OSError):
                message = _told(error)
                if _prints_json(arguments):
                    click.echo(to_json({"error": message}))
            leave(COULD_NOT_RUN)
        leave(code if isinstance(code, int) else 0)


def _prints_json(arguments: Sequence[str]) -> bool:
    """Whether JSON is asked for on the standard output, and not in a file named after --json."""
    return any(
        argument == "--json" and not after.endswith(".json")
        for argument, after in zip(arguments, [*arguments[1:], ""], strict=True)
    )


def _told(error: Exception) -> str:
    """Say on stderr what went wrong, and return it."""
    if isinstance(error, click.ClickException):
        error.show()
        return error.format_message()
    if isinstance(error, click.Abort):
        message = "interrupted"
    elif isinstance(error, HarnessError):
        message = f"error: {error}"
    elif isinstance(error, OSError):
        message = f"error: {error.filename or 'standard output'}: {error.strerror}"
    else:
        traceback.print_exc()
        return f"internal error: {error!r}"
    click.echo(message, err=True)
    return message.removeprefix("error: ")


@click.group(cls=HarnessGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="slider-resonator")
def main() -> None:
    """Run a slider-resonator FMU and say with numbers whether it is right.

    Every command leaves with 0 (pass), 1 (fail) or 2 (could not run).

    \b
    Examples:
      python -m harness validate
      python -m harness validate my.fmu --scene table_1 --scene lift_off
      python -m harness run my.fmu table_1 --out table_1.csv --plot table_1.png
      python -m harness steady my.fmu --set phase=0.4 --set load=0.05 --json
      python -m harness blocking my.fmu --json
      python -m harness choose feed_forward --json
      python -m harness paper --out paper
      python -m harness extremes --out extremes
      python -m harness sweep grid.toml --out table.parquet
      python -m harness trade table_1 --out trade
      python -m harness closed-loop --out closed_loop
      python -m harness crosscheck --out crosscheck
      python -m harness mutants --sample 200
      python -m harness baseline check my.fmu --dir baseline
    """
