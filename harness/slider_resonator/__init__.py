"""The harness: runs slider-resonator FMUs and compares them with independent references.

Any FMI 2.0 co-simulation FMU with the interface of `slider_resonator.device.interface` can be run.
It is compared with the models in `slider_resonator.references`, which share no code with any FMU.

Scripts use the names of `slider_resonator.api`, from here: `slider_resonator.fmu_path()`,
`slider_resonator.open_fmu()`. They are loaded when they are used: the command line starts faster.
"""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from slider_resonator.api import *  # noqa: F403

__version__ = "0.2.0"


def __getattr__(name: str) -> Any:
    """Load a name of the API."""
    api = importlib.import_module(f"{__name__}.api")
    if name not in (*api.__all__, "__all__"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(api, name)


def __dir__() -> list[str]:
    return [*globals(), *__getattr__("__all__")]
