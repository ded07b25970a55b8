"""The Python FMU, packaged by pythonfmu."""

import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from importlib import metadata
from pathlib import Path

from fmu_src import __version__
from fmu_src.building.archive import check_folder, write_archive
from fmu_src.building.build_error import BuildError
from fmu_src.building.content import digest_of, guid_of, icon_and_licences, reference_experiments
from fmu_src.building.dates import EPOCH, date_of_build, date_text
from fmu_src.documentation import documentation_page
from fmu_src.model_description import model_description
from fmu_src.sources import PACKAGE, PYTHON_SOURCES

SCRIPT = PYTHON_SOURCES / "slider_resonator_py.py"
MODEL = "SliderResonatorPy"


@dataclass(frozen=True)
class _Content:
    """Content of the FMU besides the files that pythonfmu adds: path -> bytes.

    `digest` (hex, SHA-256) covers the package, the description without its GUID and date, and the
    documentation. The names of package and script and the GUID follow from it, so that different
    builds in one process never share modules.
    """

    package: Mapping[str, bytes]
    extras: Mapping[str, bytes]
    generation_tool: str
    digest: str

    @property
    def package_name(self) -> str:
        """The Python package inside the FMU."""
        return f"slider_component_{self.digest[:12]}"

    @property
    def script_name(self) -> str:
        """The script that pythonfmu loads, without .py."""
        return f"slider_resonator_py_{self.digest[:12]}"


def build_python(dest: Path, package: Path = PACKAGE) -> Path:
    """Build the Python FMU in the folder `dest` (created if missing) and return its path.

    The file is replaced atomically. Its bytes depend on the sources, on the versions of pythonfmu
    and of zlib, and on the environment variable SOURCE_DATE_EPOCH, which sets the date in the
    description. `package` is the folder with the modules of the component.

    Raises BuildError.
    """
    check_folder(dest)
    date = date_of_build()
    content = _collect(package)
    files = _run_pythonfmu(content)
    guid = guid_of(content.digest)
    files["modelDescription.xml"] = _description(content.generation_tool, guid, date)
    return write_archive(dest, MODEL, files | dict(content.extras))


def _collect(package: Path) -> _Content:
    sources = {
        path.relative_to(package).as_posix(): path.read_bytes()
        for path in sorted(package.rglob("*.py"))
    }
    if "__init__.py" not in sources:
        raise BuildError(f"{package} is not a Python package: it has no __init__.py")
    try:
        tool = f"slider-resonator {__version__} (PythonFMU {metadata.version('pythonfmu')})"
    except metadata.PackageNotFoundError:
        raise BuildError("pythonfmu is not installed here; `make setup` installs it") from None
    page = documentation_page(model=MODEL, generation_tool=tool, host="python")
    extras = icon_and_licences("license.txt", "pythonfmu.txt") | reference_experiments()
    extras["documentation/index.html"] = page
    hashed = {f"package/{name}": text for name, text in sources.items()} | extras
    hashed["modelDescription.xml"] = _description(tool, guid="", generated=EPOCH)
    hashed["script"] = SCRIPT.read_bytes()
    return _Content(sources, extras, tool, digest_of(hashed))


def _run_pythonfmu(content: _Content) -> dict[str, bytes]:
    """Return path in the archive -> bytes of the files that pythonfmu makes."""
    with tempfile.TemporaryDirectory(prefix="slider_resonator_") as folder:
        stage, out = Path(folder, "stage"), Path(folder, "out")
        for name, data in content.package.items():
            path = stage / content.package_name / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        script = stage / f"{content.script_name}.py"
        text = SCRIPT.read_text(encoding="utf-8")
        inside = text.replace("from slider_component.", f"from {content.package_name}.")
        script.write_bytes(inside.encode())
        out.mkdir()
        # pythonfmu imports and runs the script: in a separate process, so that modules and search
        # path of this one do not change.
        command = [sys.executable, "-B", "-m", "pythonfmu", "build", "--no-external-tool"]
        command += ["-f", str(script), "-d", str(out), str(stage / content.package_name)]
        done = subprocess.run(command, cwd=stage, capture_output=True, text=True, check=False)
        made = list(out.glob("*.fmu"))
        if done.returncode != 0 or len(made) != 1:
            raise BuildError(f"pythonfmu could not package {script.name}:\n{done.stderr.strip()}")
        with zipfile.ZipFile(made[0]) as archive:
            return {name: archive.read(name) for name in archive.namelist()}


def _description(tool: str, guid: str, generated: datetime) -> bytes:
    return model_description(
        model=MODEL,
        guid=guid,
        generation_tool=tool,
        generated=date_text(generated),
        host_manages_memory=False,
    )
