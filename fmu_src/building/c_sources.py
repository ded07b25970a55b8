"""All C sources of the native FMUs: written by hand, generated, and the headers of FMI.

A file is named by its path below the root of the sources, as leap/leap.c. It includes others by
their path from its own folder, so that hosts that compile the sources of an FMU need no option.
"""

import importlib.util
from collections.abc import Iterable, Mapping
from fnmatch import fnmatch
from pathlib import Path, PurePosixPath
from typing import Literal

from fmu_src.building.build_error import BuildError
from fmu_src.controller.variables import VARIABLES as CONTROLLER_VARIABLES
from fmu_src.generators.c_header import c_header
from fmu_src.generators.constants import c_constants
from fmu_src.generators.parameters import c_parameters
from fmu_src.generators.refusal_texts import c_refusal_texts
from fmu_src.generators.variable_table import c_table
from fmu_src.python.slider_component.variables import VARIABLES
from fmu_src.sources import C_SOURCES, CONTROLLER_SOURCES

GUID_HEADER = "component/model_guid.h"
UNBUILT_GUID = "00000000-0000-0000-0000-000000000000"

FmiVersion = Literal["2.0", "3.0"]

FMI_HEADERS: dict[FmiVersion, tuple[str, ...]] = {
    "2.0": ("fmi2FunctionTypes.h", "fmi2Functions.h", "fmi2TypesPlatform.h"),
    "3.0": ("fmi3FunctionTypes.h", "fmi3Functions.h", "fmi3PlatformTypes.h"),
}
_FMI_FOLDER = "fmi/"

_SHELLS: dict[FmiVersion, str] = {"2.0": "fmi2*", "3.0": "fmi3*"}
"""The C files of one version of FMI only."""

SHARED = (
    "component_functions",
    "constants",
    "experiment",
    "fmi2*",
    "instance",
    "lifecycle",
    "memory",
    "model_guid",
    "refusal",
    "refusal_texts",
    "state_access",
    "state_bytes",
    "value_access",
    "values",
)
"""The slider's C files that serve any table of variables, without folder and suffix."""


def slider_sources(version: FmiVersion = "2.0") -> dict[str, str]:
    """Return path -> text of the slider's C files and headers, with UNBUILT_GUID.

    Equal sources and equal headers of fmpy give equal texts. Raises BuildError without fmpy.
    """
    others = [pattern for other, pattern in _SHELLS.items() if other != version]
    written = _read(C_SOURCES).items()
    return {
        **{name: text for name, text in written if not _is_one_of(name, others)},
        **c_table(VARIABLES, "python/slider_component/variables.py"),
        **c_parameters(VARIABLES),
        "base/constants.h": c_constants(),
        "base/refusal_texts.h": c_refusal_texts(),
        GUID_HEADER: guid_header(UNBUILT_GUID),
        **_fmi_headers(version),
    }


def controller_sources() -> dict[str, str]:
    """Return path -> text of the velocity controller's; otherwise like `slider_sources`.

    Its own files replace those of the slider of the same path.
    """
    slider = slider_sources()
    return {
        **{name: slider[name] for name in slider if _is_one_of(name, SHARED)},
        **_read(CONTROLLER_SOURCES),
        **c_table(CONTROLLER_VARIABLES, "controller/variables.py"),
    }


def guid_header(guid: str) -> str:
    """Return the text of the header with the GUID of the model description."""
    about = "The GUID of the model description."
    definition = f'#define MODEL_GUID "{guid}"\n'
    return c_header(about, "building/c_sources.py", definition)


def c_files(sources: Iterable[str]) -> list[str]:
    """Return the paths of the files to be compiled, in alphabetical order."""
    return sorted(name for name in sources if name.endswith(".c"))


def write_sources(sources: Mapping[str, str], root: Path) -> None:
    """Write C files and headers below a folder, created if missing; line ends are those of Unix."""
    root.mkdir(parents=True, exist_ok=True)
    for name, text in sources.items():
        (root / name).parent.mkdir(exist_ok=True)
        (root / name).write_text(text, encoding="utf-8", newline="\n")


def _is_one_of(name: str, patterns: Iterable[str]) -> bool:
    return any(fnmatch(PurePosixPath(name).stem, pattern) for pattern in patterns)


def _read(root: Path) -> dict[str, str]:
    # In text mode: line ends do not depend on the checkout.
    return {
        path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
        for path in root.rglob("*.[ch]")
    }


def _fmi_headers(version: FmiVersion) -> dict[str, str]:
    spec = importlib.util.find_spec("fmpy")
    if spec is None or spec.origin is None:
        raise BuildError("fmpy is not installed here; `make setup` installs it")
    folder = Path(spec.origin).parent / "c-code"
    return {
        _FMI_FOLDER + name: (folder / name).read_text(encoding="utf-8")
        for name in FMI_HEADERS[version]
    }
