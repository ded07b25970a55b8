"""What stops a command from giving a verdict. The message of each is meant for the user."""

from __future__ import annotations


class HarnessError(Exception):
    """A command could not run: exit code 2."""


class SceneError(HarnessError):
    """A scene file that cannot be read, or asks for something that does not exist."""


class FmuError(HarnessError):
    """A file that is not a usable FMU, or an FMU that failed."""


class Refusal(FmuError):
    """A call that the FMU refused; the message carries the text of the FMU's own log."""
