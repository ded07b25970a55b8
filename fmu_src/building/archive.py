"""FMU and SSP files: zip archives whose bytes depend on names and contents only."""

import os
import zipfile
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path

from fmu_src.building.build_error import BuildError
from fmu_src.building.dates import EPOCH


def check_folder(dest: Path) -> None:
    """Raise BuildError for a folder whose path leads through a file."""
    there = next(path for path in (dest, *dest.parents) if path.exists())
    if not there.is_dir():
        raise BuildError(f"folder {dest} refused: {there} is a file; must be a folder")


def write_archive(dest: Path, model: str, files: Mapping[str, bytes], suffix: str = ".fmu") -> Path:
    """Write `dest`/`model` with `suffix` and return its path; the file is replaced atomically."""
    return replace_file(dest / f"{model}{suffix}", _archive(files))


def replace_file(target: Path, content: bytes) -> Path:
    """Write a file and return its path: it has its old content or the new, nothing between."""
    target.parent.mkdir(parents=True, exist_ok=True)
    partial = target.with_suffix(f".{os.getpid()}.partial")
    try:
        partial.write_bytes(content)
        partial.replace(target)
    finally:
        partial.unlink(missing_ok=True)
    return target


def _archive(files: Mapping[str, bytes]) -> bytes:
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in sorted(files.items()):
            entry = zipfile.ZipInfo(name, EPOCH.timetuple()[:6])
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3  # Unix, on every platform: the permissions below are Unix's
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, data)
    return buffer.getvalue()
