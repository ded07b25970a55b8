"""The error of a build."""

from __future__ import annotations


class BuildError(Exception):
    """The FMU could not be built; the text says why."""
