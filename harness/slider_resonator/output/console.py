"""Where results go: to stdout, whole or not at all."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NoReturn

from rich.console import Console

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
