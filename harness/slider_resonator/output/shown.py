"""What results have in common in a script: a text that fits a screen, a table, a picture."""

import importlib
from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from slider_resonator.errors import HarnessError
from slider_resonator.output.files import PICTURE_SUFFIXES, writable
from slider_resonator.output.readable import one_line

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MAX_LINES = 22
"""Lines of a result in a session or a notebook; what is left out is counted."""


class Shown:
    """A result whose `repr` says what was found, in lines."""

    @abstractmethod
    def describe(self) -> list[str]:
        """Return what was found, a line each, the answer first."""

    def __repr__(self) -> str:
        """Return the kind of result and its lines, as many as fit a screen."""
        lines = [one_line(line) for line in self.describe()]
        left_out = len(lines) - MAX_LINES
        if left_out > 0:
            lines = [*lines[:MAX_LINES], f"... and {left_out} lines more"]
        return "\n  ".join([f"{type(self).__name__}:", *lines])


class Tabular:
    """A result with a table."""

    @abstractmethod
    def table(self) -> Mapping[str, Any]:
        """Return the columns by name: lists or arrays, all of one length."""

    def to_pandas(self) -> Any:
        """Return the table as a pandas DataFrame; HarnessError where pandas is not installed."""
        try:
            pandas = importlib.import_module("pandas")
        except ImportError:
            raise HarnessError("to_pandas() needs pandas: pip install pandas") from None
        return pandas.DataFrame(dict(self.table()))


class Drawable:
    """A result with a picture."""

    @abstractmethod
    def figure(self) -> "Figure":
        """Return the picture as a new matplotlib figure."""

    def plot(self, path: str | Path | None = None) -> "Figure":
        """Return the picture, and write it to `path`, if given: PNG, SVG or PDF.

        Raises HarnessError where that cannot be written.
        """
        figure = self.figure()
        if path is not None:
            # Imported here: drawing takes longer to load than most else.
            from slider_resonator.output.plot_style import save

            save(figure, writable(str(path), PICTURE_SUFFIXES))
        return figure
