"""How long work reports what it does: shown on stderr, and only on a terminal."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from slider_resonator.output.readable import one_line

Progress = Callable[[str, float], None]
"""Takes the present task and the share of the work done, 0 to 1."""


def no_progress(label: str, share: float) -> None:
    """Report nothing."""


def counted(label: str, done: int, total: int) -> str:
    """Return the label of a task with its number; `done` tasks are finished before it."""
    return f"{min(done + 1, total)} of {total}: {label}"


def part_of(progress: Progress, index: int, count: int) -> Progress:
    """Return a function that reports the progress of part `index` of `count` equal parts."""
    return lambda label, share: progress(label, (index + share) / count)


@contextmanager
def progress_bar() -> Iterator[Progress]:
    """Yield a function that takes the current task and the share of the work done, 0 to 1."""
    if not sys.stderr.isatty():
        yield no_progress
        return
    # Imported here: processes of FMUs report progress, and show none.
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar
    from rich.table import Column

    label = Column(ratio=1, no_wrap=True, overflow="ellipsis")
    columns = (
        TextColumn("{task.description}", markup=False, table_column=label),
        BarColumn(bar_width=10),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    console = Console(stderr=True)
    # The speed is that of the whole time: tasks are few and long.
    with Bar(
        *columns, console=console, transient=True, expand=True, speed_estimate_period=1e6
    ) as shown:
        task = shown.add_task("", total=1.0)
        yield lambda label, share: shown.update(task, description=one_line(label), completed=share)
