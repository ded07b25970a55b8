"""The velocity controller's FMU: its own law behind the FMI functions of the slider."""

from collections.abc import Callable, Sequence
from pathlib import Path

from fmu_src.building.c_sources import controller_sources
from fmu_src.building.native_fmu import NativeModel, build_model
from fmu_src.controller.variables import VARIABLES

MODEL = "VelocityController"

DESCRIPTION = "Holds the velocity of the slider with an embedded resonator by moving its phase"


def build_controller(
    dest: Path,
    *,
    platforms: Sequence[str] = (),
    compiler: str | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """Build the controller in the folder `dest` and return its path, as `build_model` does."""
    about = {"about": DESCRIPTION, "variables": VARIABLES}
    model = NativeModel(MODEL, controller_sources(), about, "controller_page.html")
    return build_model(dest, model, platforms=platforms, compiler=compiler, progress=progress)
