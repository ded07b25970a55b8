"""Where results go: to stdout, as JSON or as text, whole or not at all."""

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NoReturn

import click
from rich.console import Console

from slider_resonator.output.json_output import to_json
from slider_resonator.output.readable import escaped
from slider_resonator.output.table import Table
from slider_resonator.output.terminal import fitting, show_table, terminal_width

LOG_WIDTH = 120
"""Columns of output that does not go to a terminal."""


def output() -> Console:
    """Return the console for results, `LOG_WIDTH` columns wide where there is no terminal."""
    terminal = sys.stdout is not None and sys.stdout.isatty()
    return Console(file=sys.stdout, highlight=False, width=None if terminal else LOG_WIDTH)


def exit_with(code: int) -> NoReturn:
    """Exit with `code`, even if buffered output cannot be written.

    Python itself prints an error and exits with another code when it cannot flush a stream.
    """
    for stream in filter(None, (sys.stdout, sys.stderr)):  # None for a stream closed at the start
        try:
            stream.flush()
        except OSError:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, stream.fileno())
            os.close(nowhere)
    sys.exit(code)


def open_closed_streams() -> None:
    """Open standard streams that were closed at the start, so that no other file takes their place.

    Python has None for them, and the first files that are opened would get their numbers.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # the lowest free number
    for name, number in (("stdout", 1), ("stderr", 2)):
        if getattr(sys, name) is None:
            setattr(sys, name, os.fdopen(number, "w", encoding="utf-8", closefd=False))


@contextmanager
def noting_on_interrupt(note: Callable[[], str] = lambda: "nothing is kept") -> Iterator[None]:
    """On an interruption within the block, add a note on what is kept and how to resume."""
    try:
        yield
    except KeyboardInterrupt as error:
        error.add_note(note())
        raise


def print_result(
    result: Any, *shown: Sequence[str] | Table, as_json: bool, provenance: Any = None
) -> None:
    """Print the result as JSON, with its provenance if it has one, or as lines and tables."""
    if as_json:
        click.echo(to_json(result, provenance))
        return
    for one in shown:
        if isinstance(one, Table):
            show_table(output(), one)
        else:
            print_text("\n".join(one))


def print_text(text: str, *, err: bool = False) -> None:
    """Print text that may hold foreign parts, on standard error with `err`.

    A terminal gets lines that fit it, a file or another program gets them as they are.
    """
    click.echo(fitting(escaped(text), terminal_width(err=err)), err=err)
