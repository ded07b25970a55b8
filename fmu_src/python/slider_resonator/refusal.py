"""The error that refuses a call; its text names the thing, its value and what is allowed."""

from __future__ import annotations


class Refusal(ValueError):
    """A call that is refused. The state of the component is as it was before the call."""
