"""Progress of long work: on stderr, and only on a terminal."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, ProgressColumn, Task, TextColumn, TimeElapsedColumn
from rich.progress import Progress as Bar
from rich.text import Text

from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.output.readable import one_line

MIN_SHARE = 0.02
"""Share of the work from which on the time left is estimated."""
BAR = 10
"""Columns of the bar."""
TIMES = len("0:00:00 00:00:00 left") + 4
"""Columns of the times beside a label, with those between."""


def time_left(elapsed: float, share: float) -> str:
    """Return the time left after `elapsed` (s), assuming that all work is equally fast."""
    if not share >= MIN_SHARE:
        return ""
    seconds = round(elapsed * (1.0 / min(share, 1.0) - 1.0))
    minutes, seconds = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02} left" if hours else f"{minutes}:{seconds:02} left"


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
def progress_bar() -> Iterator[Progress]:
    """Yield a function that takes the current task and the share of the work done, 0 to 1."""
    if not sys.stderr.isatty():
        yield no_progress
        return
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(bar_width=BAR),
        TimeElapsedColumn(),
        _TimeLeftColumn(),
    )
    console = Console(stderr=True)
    room = console.width - TIMES - BAR
    with Bar(*columns, console=console, transient=True) as shown:
        task = shown.add_task("", total=1.0)
        yield lambda label, share: shown.update(
            task, description=shortened(one_line(label), room), completed=share
        )
