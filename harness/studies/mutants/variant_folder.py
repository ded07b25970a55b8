"""An unpacked FMU in which a few files are replaced for the length of a trial."""

from __future__ import annotations

import os
import py_compile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

_ASIDE = ".original"


class VariantFolder:
    """The `folder` of an unpacked FMU, whose Python modules are compiled once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        for module in folder.rglob("*.py"):
            py_compile.compile(str(module), quiet=2)

    @contextmanager
    def having(self, changed: Mapping[str, bytes]) -> Iterator[None]:
        """Replace the content of some files, by path in the FMU, for the block."""
        files = [self._folder / path for path in changed]
        moved = [*files, *(compiled for file in files for compiled in _compiled(file))]
        for file in moved:
            os.replace(file, f"{file}{_ASIDE}")
        try:
            for file, content in zip(files, changed.values(), strict=True):
                file.write_bytes(content)
            yield
        finally:
            for file in moved:
                os.replace(f"{file}{_ASIDE}", file)


def _compiled(module: Path) -> list[Path]:
    """Return what Python has compiled from a module, none for another file."""
    if module.suffix != ".py":
        return []
    return list(module.parent.glob(f"__pycache__/{module.stem}.*.pyc"))
