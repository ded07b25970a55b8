"""Builds the FMUs: `python build_fmu.py` writes dist/SliderResonatorPy.fmu."""

from __future__ import annotations

import argparse
import hashlib
import os
import subprocess
import sys
import tempfile
import uuid
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib import metadata
from io import BytesIO
from pathlib import Path

from fmu_src import __version__
from fmu_src.documentation import ASSETS, documentation_page
from fmu_src.model_description import model_description

PYTHON_SOURCES = Path(__file__).resolve().parent / "fmu_src" / "python"
PACKAGE = PYTHON_SOURCES / "slider_resonator"
SCRIPT = PYTHON_SOURCES / "slider_resonator_py.py"
MODEL = "SliderResonatorPy"

# The first moment that a zip archive can express.
_EPOCH = datetime(1980, 1, 1, tzinfo=UTC)


class BuildError(Exception):
    """The FMU could not be built; the text says why."""


@dataclass(frozen=True)
class Content:
    """What an FMU is made of, apart from the files that pythonfmu adds: path -> bytes.

    `digest` (hex, SHA-256) covers the package, the description without its GUID and date, and the
    documentation: the name of the package and the GUID follow from it, so that two different
    builds never share modules when one process loads both.
    """

    package: Mapping[str, bytes]
    extras: Mapping[str, bytes]
    generation_tool: str
    digest: str

    @property
    def package_name(self) -> str:
        """The Python package inside the FMU."""
        return f"slider_resonator_{self.digest[:12]}"

    @property
    def script_name(self) -> str:
        """The script that pythonfmu loads, without .py."""
        return f"slider_resonator_py_{self.digest[:12]}"

    @property
    def guid(self) -> str:
        """The GUID of the model description."""
        return str(uuid.UUID(hex=self.digest[:32]))


def build_python(dest: Path, package: Path = PACKAGE) -> Path:
    """Build the Python FMU in the folder `dest` (created if missing) and return its path.

    The bytes depend on the sources, on the versions of pythonfmu and of zlib, and on the
    environment variable SOURCE_DATE_EPOCH, which sets the date in the description. The file appears
    at once or not at all. `package` is the component, a folder with Python modules.

    Raises BuildError.
    """
    _check_folder(dest)
    date = _date()
    content = _collect(package)
    files = _run_pythonfmu(content)
    files["modelDescription.xml"] = _description(content.generation_tool, content.guid, date)
    files |= content.extras
    dest.mkdir(parents=True, exist_ok=True)
    target = dest / f"{MODEL}.fmu"
    partial = target.with_suffix(f".{os.getpid()}.partial")
    try:
        partial.write_bytes(_archive(files))
        partial.replace(target)
    finally:
        partial.unlink(missing_ok=True)
    return target


def _check_folder(dest: Path) -> None:
    """Refuse a folder that cannot be created because a file is in its place or in its way."""
    there = next(path for path in (dest, *dest.parents) if path.exists())
    if not there.is_dir():
        raise BuildError(f"folder {dest} refused: {there} is a file; allowed is a folder")


def _collect(package: Path) -> Content:
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
    extras = {
        "documentation/index.html": documentation_page(model=MODEL, generation_tool=tool),
        "model.png": (ASSETS / "model.png").read_bytes(),
    }
    for licence in sorted((ASSETS / "licenses").glob("*.txt")):
        extras[f"documentation/licenses/{licence.name}"] = licence.read_bytes()
    hashed = {f"package/{name}": text for name, text in sources.items()} | extras
    hashed["modelDescription.xml"] = _description(tool, guid="", generated=_EPOCH)
    hashed["script"] = SCRIPT.read_bytes()
    digest = hashlib.sha256()
    for name, data in sorted(hashed.items()):
        for part in (name.encode(), data):
            digest.update(len(part).to_bytes(8, "big") + part)
    return Content(sources, extras, tool, digest.hexdigest())


def _run_pythonfmu(content: Content) -> dict[str, bytes]:
    """The files of the FMU that pythonfmu makes, by their path in the archive."""
    with tempfile.TemporaryDirectory(prefix="slider_resonator_") as folder:
        stage, out = Path(folder, "stage"), Path(folder, "out")
        for name, data in content.package.items():
            path = stage / content.package_name / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        script = stage / f"{content.script_name}.py"
        text = SCRIPT.read_text(encoding="utf-8")
        inside = text.replace("from slider_resonator.", f"from {content.package_name}.")
        script.write_bytes(inside.encode())
        out.mkdir()
        # pythonfmu imports the script and runs it: in a process of its own, that of the caller
        # keeps its modules and its search path.
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
        generated=generated.strftime("%Y-%m-%dT%H:%M:%SZ"),
    )


def _date() -> datetime:
    seconds = os.environ.get("SOURCE_DATE_EPOCH")
    if seconds is None:
        return _EPOCH
    try:
        if int(seconds) < 0:
            raise ValueError(seconds)
        return datetime.fromtimestamp(int(seconds), UTC)
    except (ValueError, OverflowError, OSError):
        raise BuildError(
            f"SOURCE_DATE_EPOCH = {seconds!r} refused: allowed is a whole number of seconds "
            "since 1970-01-01, not below 0"
        ) from None


def _archive(files: Mapping[str, bytes]) -> bytes:
    """A zip archive whose bytes follow from names and contents only."""
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in sorted(files.items()):
            entry = zipfile.ZipInfo(name, _EPOCH.timetuple()[:6])
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3  # Unix, wherever it is built: the permissions below are its
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, data)
    return buffer.getvalue()


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="build_fmu.py",
        description=f"Build {MODEL}.fmu, the FMI 2.0 co-simulation FMU made with pythonfmu.",
        epilog="The same sources give the same bytes. The environment variable SOURCE_DATE_EPOCH "
        "(seconds since 1970-01-01) sets the date in the model description; without it the date "
        f"is {_EPOCH:%Y-%m-%d}. Exit code 0: built; 2: could not be built.",
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("dist"),
        metavar="FOLDER",
        help="folder for the FMU, created if missing (default: %(default)s)",
    )
    folder: Path = parser.parse_args(arguments).out
    try:
        fmu = build_python(folder)
    except BuildError as error:
        print(f"build_fmu.py: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"build_fmu.py: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    print(f"{fmu}: {fmu.stat().st_size} bytes, SHA-256 {_sha256(fmu)}")
    return 0


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


if __name__ == "__main__":
    sys.exit(main())
