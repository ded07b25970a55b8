"""Native FMUs: binaries for every platform, with their source code."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from fmu_src import __version__
from fmu_src.building.archive import check_folder, write_archive
from fmu_src.building.build_error import BuildError
from fmu_src.building.c_sources import GUID_HEADER, FmiVersion, c_files, guid_header, slider_sources
from fmu_src.building.compiling import Compiler, compile_binaries, default_compiler, named_compiler
from fmu_src.building.content import digest_of, guid_of, icon_and_licences, reference_experiments
from fmu_src.building.dates import EPOCH, date_of_build, date_text
from fmu_src.building.platforms import HOST, Platform, host_platform, platforms_named
from fmu_src.building.web_page import NAME as PAGE
from fmu_src.building.web_page import UPLOT_LICENCE, page_files, web_page
from fmu_src.documentation import documentation_page
from fmu_src.fmi3_documents import build_description, terminals_and_icons
from fmu_src.model_description import DESCRIPTION, model_description
from fmu_src.model_description_3 import model_description_3
from fmu_src.python.slider_component.variables import VARIABLES

MODEL = "SliderResonator"
MODEL_3 = "SliderResonator3"


@dataclass(frozen=True)
class NativeModel:
    """What distinguishes one native FMU from another.

    `code` is its C sources: path in the folder `sources` -> text. `details` are arguments of both
    the model description and the documentation page, `page` of the page alone. `version` is that of
    FMI. `takes_derivatives` is for one of FMI 2.0 that takes derivatives of inputs.
    `is_slider` adds the page that runs the component, and reference experiments.
    """

    name: str
    code: Mapping[str, str]
    details: Mapping[str, Any]
    page: str
    version: FmiVersion = "2.0"
    takes_derivatives: bool = False
    is_slider: bool = False


def build_native(
    dest: Path,
    *,
    platforms: Sequence[str] = (),
    compiler: str | None = None,
    code: Mapping[str, str] | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """Build the native slider, from other C sources if `code` is given; see `build_model`."""
    about = {"about": DESCRIPTION, "variables": VARIABLES}
    model = NativeModel(
        MODEL, code or slider_sources(), about, "page.html", takes_derivatives=True, is_slider=True
    )
    return build_model(dest, model, platforms=platforms, compiler=compiler, progress=progress)


def build_native_3(
    dest: Path,
    *,
    platforms: Sequence[str] = (),
    compiler: str | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """Build the native slider for FMI 3.0; see `build_model`."""
    about = {"about": DESCRIPTION, "variables": VARIABLES}
    model = NativeModel(MODEL_3, slider_sources("3.0"), about, "page.html", "3.0", is_slider=True)
    return build_model(dest, model, platforms=platforms, compiler=compiler, progress=progress)


def build_model(
    dest: Path,
    model: NativeModel,
    *,
    platforms: Sequence[str] = (),
    compiler: str | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """Build a native FMU in the folder `dest` (created if missing) and return its path.

    `platforms` are names of `platforms_of` or `host`; none means all and the page for browsers, or
    `host` with a `compiler`. The default compiler is ziglang, which compiles for all; `compiler` is
    one for this machine.

    The file is replaced atomically. Its bytes depend on the sources, the compiler, the FMI headers
    of fmpy, the version of zlib and the environment variable SOURCE_DATE_EPOCH, which sets the date
    in the description; for macOS zig's linker leaves random bytes in the padding.

    Raises BuildError.
    """
    check_folder(dest)
    date = date_of_build()
    tool, chosen = _toolchain(model.version, platforms, compiler)
    generation_tool = _generation_tool(tool)
    files = _FILES[model.version](model)
    files["documentation/index.html"] = documentation_page(
        model=model.name,
        generation_tool=generation_tool,
        host="native" if model.version == "2.0" else "native_3",
        page=model.page,
        **model.details,
    )
    if model.is_slider:
        files |= reference_experiments()
    undated = _description(model, generation_tool, "", EPOCH)
    hashed = files | _encoded(model.code) | {"modelDescription.xml": undated}
    if model.is_slider:
        hashed |= {f"page/{name}": text.encode() for name, text in page_files().items()}
        if not platforms and compiler is None:
            progress("compiling for WebAssembly")
            files[f"documentation/{PAGE}"] = web_page(slider_sources(), tool)
            files["documentation/licenses/uplot.txt"] = UPLOT_LICENCE.read_bytes()
    guid = guid_of(digest_of(hashed))
    code = {**model.code, GUID_HEADER: guid_header(guid)}
    files |= _encoded(code)
    files |= compile_binaries(code, model.name, chosen, tool, progress, model.version)
    files["modelDescription.xml"] = _description(model, generation_tool, guid, date)
    return write_archive(dest, model.name, files)


def _toolchain(
    version: FmiVersion, platforms: Sequence[str], compiler: str | None
) -> tuple[Compiler, list[Platform]]:
    """Return the compiler and the platforms for which it compiles; see `build_model`."""
    if compiler is None:
        return default_compiler(), platforms_named(platforms, version)
    here = host_platform(version)
    chosen = platforms_named(platforms or [HOST], version)
    tool = named_compiler(compiler)
    if chosen != [here]:
        names = ", ".join(p.name for p in chosen)
        raise BuildError(
            f"compiler {compiler!r} refused for {names}: must be {here.name}, the platform of this "
            "machine; ziglang compiles for the others"
        )
    return tool, chosen


def _encoded(code: Mapping[str, str]) -> dict[str, bytes]:
    return {f"sources/{name}": text.encode() for name, text in code.items()}


def _generation_tool(compiler: Compiler) -> str:
    return f"slider-resonator {__version__} ({compiler.description})"


def _description(model: NativeModel, tool: str, guid: str, generated: datetime) -> bytes:
    about = {"model": model.name, "guid": guid, "generation_tool": tool, **model.details}
    if model.version == "3.0":
        return model_description_3(generated=date_text(generated), **about)
    return model_description(
        generated=date_text(generated),
        host_manages_memory=True,
        takes_derivatives=model.takes_derivatives,
        source_files=_source_files(model),
        **about,
    )


def _source_files(model: NativeModel) -> list[str]:
    return c_files(model.code)


def _files_2(model: NativeModel) -> dict[str, bytes]:
    """Return path in the FMU -> bytes of the files of any build for FMI 2.0."""
    return icon_and_licences("license.txt", "fmi2.txt", "fmpy.txt")


def _files_3(model: NativeModel) -> dict[str, bytes]:
    """Return path in the FMU -> bytes of the files of any build for FMI 3.0."""
    return {
        **icon_and_licences("license.txt", "fmi3.txt", icon="terminalsAndIcons/icon.png"),
        "terminalsAndIcons/terminalsAndIcons.xml": terminals_and_icons(),
        "sources/buildDescription.xml": build_description(model.name, _source_files(model)),
    }


_FILES: dict[FmiVersion, Callable[[NativeModel], dict[str, bytes]]] = {
    "2.0": _files_2,
    "3.0": _files_3,
}
