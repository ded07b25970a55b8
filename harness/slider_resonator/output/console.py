"""Where output goes: results to stdout, progress to stderr and only on a terminal."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NoReturn

from rich.console import Console
from rich.progress import (
    BarColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
)
from rich.text import Text

from slider_resonator.output.terminal import one_line

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
def noting_on_interrupt(note: Callable[[], str]) -> Iterator[None]:
    """On an interruption within the block, add a note on what is kept and how to resume."""
    try:
        yield
    except KeyboardInterrupt as error:
        error.add_note(note())
        raise


MIN_SHARE = 0.02
"""Share of the work from which on the time left is estimated."""


def counted(label: str, done: int, total: int) -> str:
    """Return the label of a task with its number; `done` tasks are finished before it."""
    return f"{min(done + 1, total)} of {total}: {label}"


def part_of(
    progress: Callable[[str, float], None], index: int, count: int
) -> Callable[[str, float], None]:
    """Return a function that reports the progress of part `index` of `count` equal parts."""
    return lambda label, share: progress(label, (index + share) / count)


def time_left(elapsed: float, share: float) -> str:
    """Return the time left after `elapsed` (s), assuming that all work is equally fast."""
    if not share >= MIN_SHARE:
        return ""
    seconds = round(elapsed * (1.0 / min(share, 1.0) - 1.0))
    minutes, seconds = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02} left" if hours else f"{minutes}:{seconds:02} left"


BAR = 10
"""Columns of the bar."""
MIN_WIDTH_FOR_BAR = 80
TIMES = len("0:00:00 00:00:00 left") + 4
"""Columns of the times beside a label, with those between."""


def shortened(label: str, room: int) -> str:
    """Return a label that fits on its line: the middle of a longer one is replaced by dots."""
    if len(label) <= room:
        return label
    end = room // 2
    return f"{label[: room - end - 1]}\N{HORIZONTAL ELLIPSIS}{label[len(label) - end :]}"


class _TimeLeftColumn(ProgressColumn):
    """The time left, by the share that is done: tasks are few and long."""

    def render(self, task: Task) -> Text:
        """Return the estimate, empty at the beginning."""
        return Text(time_left(task.elapsed or 0.0, task.completed))


@contextmanager
def progress_bar() -> Iterator[Callable[[str, float], None]]:
    """Yield a function that takes the current task and the share of the work done, 0 to 1."""
    if not sys.stderr.isatty():
        yield lambda label, share: None
        return
    console = Console(stderr=True)
    bar = BarColumn(bar_width=BAR) if console.width >= MIN_WIDTH_FOR_BAR else TextColumn("")
    columns = (
        TextColumn("{task.description}", markup=False),
        bar,
        TimeElapsedColumn(),
        _TimeLeftColumn(),
    )
    room = console.width - TIMES - (BAR if isinstance(bar, BarColumn) else 0)
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("", total=1.0)
        yield lambda label, share: progress.update(
            task, description=shortened(one_line(label), room), completed=share
        )
