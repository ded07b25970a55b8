"""Where output goes: results to stdout, progress to stderr and only on a terminal."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NoReturn

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

WIDTH_OF_A_LOG = 120


def output() -> Console:
    """Return the console for results; 120 columns wide where there is no terminal."""
    terminal = sys.stdout is not None and sys.stdout.isatty()
    return Console(file=sys.stdout, highlight=False, width=None if terminal else WIDTH_OF_A_LOG)


def leave(code: int) -> NoReturn:
    """End the process with `code`, whatever its output still holds and cannot be rid of.

    Python itself would end with another code, and complain, when it cannot flush its streams.
    """
    for stream in filter(None, (sys.stdout, sys.stderr)):  # None where it was closed from the start
        try:
            stream.flush()
        except OSError:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, stream.fileno())
            os.close(nowhere)
    sys.exit(code)


@contextmanager
def progress_bar() -> Iterator[Callable[[str, float], None]]:
    """Yield a function that is told what is at work and which share of it is done."""
    if not sys.stderr.isatty():
        yield lambda label, share: None
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("", total=1.0)
        yield lambda label, share: progress.update(task, description=label, completed=share)
