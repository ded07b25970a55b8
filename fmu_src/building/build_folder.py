"""The folder in which a target is compiled.

zig finds a compiled file in its cache only where folder and times are the same. So each target has
a folder, and a build compiles what differs from the last one, whichever FMU that was.
"""

import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TextIO

from fmu_src.building.c_sources import write_sources
from fmu_src.building.cache import cache_folder

if sys.platform != "win32":
    import fcntl


@contextmanager
def build_folder(target: str | None, sources: Mapping[str, str]) -> Iterator[Path]:
    """Give a folder with these C files and headers (path -> text) and nothing else.

    It is that of the target, once no other build uses it. Without a target, where files cannot be
    locked and where no cache can be written it is a temporary one.
    """
    lock = _lock_file(target)
    if lock is None:
        with TemporaryDirectory(prefix="slider_resonator_") as temporary:
            write_sources(sources, Path(temporary))
            yield Path(temporary)
        return
    with lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        folder = Path(lock.name).with_suffix("")
        _update(folder, sources)
        yield folder


def _lock_file(target: str | None) -> TextIO | None:
    """The file whose lock keeps other builds out of the target's folder, None without a folder."""
    base = cache_folder()
    if target is None or base is None or sys.platform == "win32":
        return None
    try:
        # Not `target` alone: older checkouts keep a folder of that name, without folders in it.
        (base / f"{target}-tree").mkdir(exist_ok=True)
        return (base / f"{target}-tree.lock").open("w")
    except OSError:
        return None


def _update(folder: Path, sources: Mapping[str, str]) -> None:
    """Make the folder hold the sources alone; what is the same keeps its time."""
    same = set()
    for path in [path for path in folder.rglob("*") if path.is_file()]:
        name = path.relative_to(folder).as_posix()
        text = sources.get(name)
        if text is not None and path.read_bytes() == text.encode():
            same.add(name)
        else:
            path.unlink()
    write_sources({n: text for n, text in sources.items() if n not in same}, folder)
