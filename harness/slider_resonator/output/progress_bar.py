"""Progress of long work: on stderr, and only on a terminal."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.progress import Progress as Bar
from rich.table import Column

from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.output.readable import one_line

MEMORY = 1e6
"""Time (s) over which the speed is averaged: tasks are few and long."""


@contextmanager
def progress_bar() -> Iterator[Progress]:
    """Yield a function that takes the current task and the share of the work done, 0 to 1."""
    if not sys.stderr.isatty():
        yield no_progress
        return
    label = Column(ratio=1, no_wrap=True, overflow="ellipsis")
    columns = (
        TextColumn("{task.description}", markup=False, table_column=label),
        BarColumn(bar_width=10),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    console = Console(stderr=True)
    with Bar(
        *columns, console=console, transient=True, expand=True, speed_estimate_period=MEMORY
    ) as shown:
        task = shown.add_task("", total=1.0)
        yield lambda label, share: shown.update(task, description=one_line(label), completed=share)
