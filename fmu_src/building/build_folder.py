"""The folder in which a target is compiled.

zig finds a compiled file in its cache only where folder and times are the same. So each target has
a folder, and a build compiles what differs from the last one, whichever FMU that was.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from fmu_src.building.c_sources import write_sources

if sys.platform != "win32":
    import fcntl


@contextmanager
def build_folder(target: str | None, sources: Mapping[str, str]) -> Iterator[Path]:
    """Give a folder with these C files and headers (name -> text) and nothing else.

    It is that of the target, once no other build uses it. Without a target, where files cannot be
    locked and where no cache can be written it is a temporary one.
    """
    with TemporaryDirectory(prefix="slider_resonator_") as temporary:
        if target is None or sys.platform == "win32":
            write_sources(sources, Path(temporary))
            yield Path(temporary)
            return
        try:
            base = Path.home() / ".cache" / "slider-resonator"
            (base / target).mkdir(parents=True, exist_ok=True)
            lock = (base / f"{target}.lock").open("w")
        except (OSError, RuntimeError):
            write_sources(sources, Path(temporary))
            yield Path(temporary)
            return
        with lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            _update(base / target, sources)
            yield base / target


def _update(folder: Path, sources: Mapping[str, str]) -> None:
    """Make the folder hold the sources alone; what is the same keeps its time."""
    same = set()
    for path in folder.iterdir():
        text = sources.get(path.name)
        if text is not None and path.read_bytes() == text.encode():
            same.add(path.name)
        else:
            path.unlink()
    write_sources({n: text for n, text in sources.items() if n not in same}, folder)
