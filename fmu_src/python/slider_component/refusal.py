"""The error of a refused call; its text names the thing, its value and what it must be."""

from __future__ import annotations


class Refusal(ValueError):
    """A refused call. The component is as it was before the call."""
