"""What builds keep in the user's home folder for the next one; `make distclean` removes it."""

import hashlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from fmu_src.building.archive import replace_file

KEPT = 6
"""Contents that are kept of one name: those of branches and changes that alternate."""
_DIGEST = hashlib.sha256().digest_size


def cache_folder() -> Path | None:
    """Return the folder, which is made if need be; None where there can be none."""
    try:
        folder = Path.home() / ".cache" / "slider-resonator"
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return None
    return folder


def cached(name: str, origin: bytes, make: Callable[[], bytes]) -> bytes:
    """Return what `make` returned under this name from this origin, or make it anew.

    `origin` is all that it depends on. The last KEPT of a name are kept. A file that is damaged
    does not count.
    """
    folder = cache_folder()
    if folder is None:
        return make()
    path = folder / f"{name}.{hashlib.sha256(origin).hexdigest()[:16]}.made"
    with suppress(OSError):
        kept = path.read_bytes()
        content = kept[_DIGEST:]
        if kept[:_DIGEST] == _digest(origin, content):
            return content
    content = make()
    with suppress(OSError):  # a full disk: the next build makes it again
        replace_file(path, _digest(origin, content) + content)
        others = folder.glob(f"{name}.{'?' * 16}.made")
        of_the_name = sorted(others, key=lambda made: made.stat().st_mtime)
        for old in of_the_name[:-KEPT]:
            old.unlink()
    return content


def _digest(origin: bytes, content: bytes) -> bytes:
    return hashlib.sha256(hashlib.sha256(origin).digest() + content).digest()
