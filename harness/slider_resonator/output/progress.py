"""How long work reports what it does; without a listener nothing is shown."""

from collections.abc import Callable

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
