"""Progress of long work: on stderr, and only on a terminal."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.progress import Progress as Bar

from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.output.readable import one_line

BAR = 10
"""Columns of the bar."""
TIMES = len("0:00:00 0:00:00") + 4
"""Columns of the times beside a label, with those between."""
MEMORY = 1e6
"""Time (s) over which the speed is averaged: tasks are few and long."""


@contextmanager
def progress_bar() -> Iterator[Progress]:
    """Yield a function that takes the current task and the share of the work done, 0 to 1."""
    if not sys.stderr.isatty():
        yield no_progress
        return
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(bar_width=BAR),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    console = Console(stderr=True)
    room = console.width - TIMES - BAR
    with Bar(*columns, console=console, transient=True, speed_estimate_period=MEMORY) as shown:
        task = shown.add_task("", total=1.0)

        def show(label: str, share: float) -> None:
            text = one_line(label)
            if len(text) > room:  # it fits on its line: dots replace the middle
                end = room // 2
                text = f"{text[: room - end - 1]}\N{HORIZONTAL ELLIPSIS}{text[len(text) - end :]}"
            shown.update(task, description=text, completed=share)

        yield show
