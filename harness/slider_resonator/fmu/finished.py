"""The finished files that an installation brings, or that a build in a checkout has made."""

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from slider_resonator.errors import FmuError

Build = Literal["native", "python", "fmi3"]

FMUS: dict[Build, str] = {
    "native": "SliderResonator.fmu",
    "python": "SliderResonatorPy.fmu",
    "fmi3": "SliderResonator3.fmu",
}

_PACKAGE = Path(__file__).resolve().parents[1]
FOLDERS = (_PACKAGE / "finished", _PACKAGE.parents[1] / "dist")
"""Of an installed package; of a checkout."""
COMMANDS_LOOK_IN = (Path("dist"), *FOLDERS)
"""A command takes what has been built in the present folder first."""


def fmu_path(build: Build = "native") -> Path:
    """Return the path of a finished FMU: the native one, the Python one, or that for FMI 3.0.

    Raises FmuError for another name, and where there is no such file.
    """
    if build not in FMUS:
        names = ", ".join(map(repr, FMUS))
        raise FmuError(f"build = {build!r}: must be one of {names}")
    return finished_path(FMUS[build])


def finished_path(name: str, folders: Sequence[Path] | None = None) -> Path:
    """Return the path of a finished file; FmuError, with the remedy, where there is none."""
    for folder in FOLDERS if folders is None else folders:
        if (folder / name).is_file():
            return folder / name
    raise FmuError(
        f"{name}: not installed and not built; in a checkout `make build` builds it, and "
        "`pip install .` installs it"
    )
