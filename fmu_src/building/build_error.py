"""The error of a failed build."""

from __future__ import annotations


class BuildError(Exception):
    """The FMU cannot be built; the text gives the reason."""
