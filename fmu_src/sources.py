"""Folders with the sources of the FMUs."""

from pathlib import Path

_HERE = Path(__file__).resolve().parent

C_SOURCES = _HERE / "c"
"""The native slider; other native FMUs take their FMI functions from it."""

CONTROLLER_SOURCES = _HERE / "controller" / "c"
"""What the velocity controller adds to the FMI functions of the slider."""

PYTHON_SOURCES = _HERE / "python"

PACKAGE = PYTHON_SOURCES / "slider_component"
"""The Python slider."""
