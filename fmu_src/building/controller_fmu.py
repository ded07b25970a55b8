"""The velocity controller's FMU: its own law behind the FMI functions of the slider."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from fmu_src.building.native_fmu import NativeModel, build_model, read_sources
from fmu_src.controller.variables import VARIABLES
from fmu_src.sources import C_SOURCES, CONTROLLER_SOURCES

MODEL = "VelocityController"

DESCRIPTION = "Holds the velocity of the slider with an embedded resonator by moving its phase"

SHELL = (
    "component_functions.h",
    "constants.h",
    "experiment.[ch]",
    "fmi2*.[ch]",
    "instance.[ch]",
    "lifecycle.h",
    "model_guid.h",
    "refusal.[ch]",
    "refusal_texts.h",
    "state_bytes.[ch]",
    "values.[ch]",
)
"""The slider's C files that serve any table of variables."""


def build_controller(
    dest: Path,
    *,
    platforms: Sequence[str] = (),
    compiler: str | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """Build the controller in the folder `dest` and return its path, as `build_model` does."""
    own = {
        path.name: path.read_bytes()
        for pattern in ("*.c", "*.h")
        for path in sorted(CONTROLLER_SOURCES.glob(pattern))
    }
    model = NativeModel(
        MODEL,
        read_sources(C_SOURCES, SHELL) | own,
        {"about": DESCRIPTION, "variables": VARIABLES},
        "controller_page.html",
    )
    return build_model(dest, model, platforms=platforms, compiler=compiler, progress=progress)
