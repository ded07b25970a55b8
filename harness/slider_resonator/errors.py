"""Errors that stop a command before a verdict; their messages are shown to the user."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches


class HarnessError(Exception):
    """A command could not run: exit code 2."""


class SceneError(HarnessError):
    """A scene or grid file that cannot be read, or a scene that asks for what does not exist."""


class FmuError(HarnessError):
    """A file that is not a usable FMU, or an FMU that failed."""


class Refusal(FmuError):
    """A call that the FMU refused; the message carries the text of the FMU's own log."""


class NotApplicable(FmuError):
    """A check that needs what the FMU does not have, and may lack: it says nothing about it."""


@contextmanager
def explained(where: str = "", kind: type[Exception] = SceneError) -> Iterator[None]:
    """Turn a ValueError or OSError of the block into another error that says `where` before it."""
    try:
        yield
    except OSError as error:
        raise kind(f"{where}{error.strerror or error}") from error
    except ValueError as error:
        raise kind(f"{where}{error}") from None


SYMBOLS = {
    "M": "slider_mass",
    "m": "resonator_mass",
    "xi": "damping_ratio",
    "zeta": "damping_ratio",
    "A": "base_amplitude",
    "w": "drive_frequency",
    "omega": "drive_frequency",
    "N0": "normal_preload",
    "mu": "friction_coefficient",
    "phi": "phase",
}
"""What books call parameters and inputs."""
MAX_LISTED = 60
"""Number of allowed names up to which a message lists them all."""
MAX_NEAR = 8
"""Number of names that it lists of more."""


def unknown_name(kind: str, name: str, allowed: Iterable[str]) -> str:
    """Return "unknown KIND 'NAME'", with the nearest of the allowed names and all, or some of many.

    The other names of many are those that resemble it most.
    """
    names = sorted(allowed)
    by_folded = {candidate.lower(): candidate for candidate in names}
    near = [by_folded[one] for one in get_close_matches(name.lower(), by_folded, n=1, cutoff=0.5)]
    parts = [one for one in names if name.lower() in one.lower().split("_")]
    if SYMBOLS.get(name) in names:
        near = [SYMBOLS[name]]
    elif len(parts) == 1:
        near = parts
    hint = f"; did you mean {near[0]!r}?" if near else ""
    listed = ", ".join(names)
    if len(names) > MAX_LISTED:
        alike = get_close_matches(name.lower(), by_folded, n=MAX_NEAR, cutoff=0.0)
        listed = f"{len(names)}, such as {', '.join(by_folded[one] for one in alike)}"
    return f"unknown {kind} {name!r}{hint} (must be one of {listed})"
