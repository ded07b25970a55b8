"""The page that runs the component: one HTML file with the C kernel inside as WebAssembly."""

import base64
import gzip
import json
import re
from collections.abc import Callable, Mapping
from pathlib import Path

from fmu_src import __version__
from fmu_src.building.archive import check_folder, replace_file
from fmu_src.building.c_sources import slider_sources
from fmu_src.building.compiling import Compiler, compile_binary, default_compiler
from fmu_src.python.slider_component.variable import Variable
from fmu_src.python.slider_component.variables import VARIABLES
from fmu_src.units import UNITS

NAME = "slider-resonator.html"

FOLDER = Path(__file__).parents[1] / "page"
UPLOT = Path(__file__).parents[2] / "harness" / "slider_resonator" / "output" / "vendor"
"""The library that draws curves, shared as files with the reports of the harness."""
UPLOT_LICENCE = UPLOT / "LICENSE"
DEVICES = Path(__file__).parents[2] / "harness" / "slider_resonator" / "scenes" / "devices"
"""The devices to start from, shared as files with the command `device`."""
FIRST_DEVICE = "table_1"
SCRIPTS = (
    *("component.js", "units.js", "device_file.js", "settings.js", "ranges.js"),
    *("curves.js", "run.js", "results.js", "controls.js", "files.js"),
    *("chart.js", "plots.js", "summary.js", "sketch.js", "main.js"),
)
"""In this order they are one JavaScript module."""

_FMI_SHELL = re.compile(r"(.*/)?(fmi2(?!_version)|instance\.|(state|value)_access\.)")
"""Files that the kernel does not need: of FMI it needs the names alone."""

_TARGET = "wasm32-wasi"
_FLAGS = (
    *("-mexec-model=reactor", "-std=c99", "-O2", "-g0", "-ffp-contract=off"),
    *("-fno-math-errno", "-Wl,--strip-all"),
)


def page_files() -> dict[str, str]:
    """Return name -> text of everything that makes the page but the kernel."""
    paths = [*FOLDER.glob("*.*"), *UPLOT.glob("uPlot*"), *DEVICES.glob("*.toml")]
    return {path.name: path.read_text(encoding="utf-8") for path in sorted(paths)}


def build_page(dest: Path, *, progress: Callable[[str], None] = lambda _: None) -> Path:
    """Write the page into the folder `dest` (created if missing) and return its path.

    The file is replaced atomically. Raises BuildError.
    """
    check_folder(dest)
    progress("compiling for WebAssembly")
    return replace_file(dest / NAME, web_page(slider_sources(), default_compiler()))


def web_page(code: Mapping[str, str], compiler: Compiler) -> bytes:
    """Return the page as UTF-8 bytes, its kernel compiled from C sources (path -> text).

    Needs no network and no other file; equal sources and compilers give equal bytes. Raises
    BuildError with the compiler's messages.
    """
    files = page_files()
    sources = {name: text for name, text in code.items() if not _FMI_SHELL.match(name)}
    sources["page.c"] = files["page.c"]
    kernel = compile_binary(sources, "page.wasm", _TARGET, _FLAGS, compiler)
    devices = sorted(DEVICES.glob("*.toml"), key=lambda path: (path.stem != FIRST_DEVICE, path))
    parts = {
        "version": __version__,
        "style": files["page.css"],
        "uplot_style": files["uPlot.min.css"],
        "uplot": files["uPlot.iife.min.js"],
        "variables": _script_json([_row(i, v) for i, v in enumerate(VARIABLES)]),
        "devices": _script_json({path.stem: files[path.name] for path in devices}),
        "component": base64.b64encode(gzip.compress(kernel, mtime=0)).decode(),
        "script": "\n".join(files[name] for name in SCRIPTS),
    }
    page = re.sub(r"\{\{(\w+)\}\}", lambda part: parts[part[1]], files["page.html"])
    return page.encode()


def _script_json(content: object) -> str:
    return json.dumps(content).replace("<", "\\u003c")


def _row(reference: int, variable: Variable) -> dict[str, object]:
    factors = UNITS[variable.unit].display if variable.unit else {}
    return {
        "reference": reference,
        "name": variable.name,
        "description": variable.description,
        "causality": variable.causality,
        "start": variable.start,
        "unit": variable.unit or "1",
        "display_unit": variable.display_unit,
        "factor": factors[variable.display_unit] if variable.display_unit else 1.0,
    }
