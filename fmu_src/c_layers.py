"""The layers of the C sources: an include goes down, and files include each other in no circle.

`python -m fmu_src.c_layers [ROOT]` checks the slider's sources, or those below another folder. A
header and the C file of its name count as one file. Generated headers are known by their folder
alone; that they exist is for the compiler to say.
"""

import posixpath
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath

from fmu_src.sources import C_SOURCES

LAYERS = ("base", "device", "friction", "resolved", "averaged", "leap", "component", "fmi")
"""The folders, each above those before it."""

_INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def faults_of(sources: Mapping[str, str]) -> list[str]:
    """Return a sentence for each fault of C files and headers (path -> text)."""
    included = {
        name: [_path(name, found) for found in _INCLUDE.findall(text)]
        for name, text in sorted(sources.items())
    }
    return [
        *_misplaced(sources),
        *_upward(included),
        *(f"{' includes '.join(circle)}: a circle" for circle in _circles(included)),
    ]


def _path(name: str, included: str) -> str:
    return posixpath.normpath(posixpath.join(posixpath.dirname(name), included))


def _misplaced(sources: Mapping[str, str]) -> Iterator[str]:
    seen: dict[str, str] = {}
    for name in sorted(sources):
        place = PurePosixPath(name)
        if str(place.parent) not in LAYERS:
            yield f"{name}: must be in one of the folders {', '.join(LAYERS)}"
        # Some compilers put the objects of all folders into one.
        twin = seen.setdefault(place.name, name)
        if twin != name:
            yield f"{name}: {twin} has the same name; must be unique"


def _upward(included: Mapping[str, list[str]]) -> Iterator[str]:
    rank = {layer: i for i, layer in enumerate(LAYERS)}
    for name, paths in included.items():
        for path in paths:
            here, there = (rank.get(posixpath.dirname(p)) for p in (name, path))
            if there is None:
                yield f"{name} includes {path}, which is in no layer"
            elif here is not None and there > here:
                yield f"{name} includes {path}, which is above it"


def _circles(included: Mapping[str, list[str]]) -> list[list[str]]:
    """Return each circle once, from its first file by name on, with that again at its end."""
    below: dict[str, set[str]] = {}
    for name, paths in included.items():
        file = posixpath.splitext(name)[0]
        below.setdefault(file, set()).update(posixpath.splitext(path)[0] for path in paths)
        below[file].discard(file)
    circles, done = [], set[str]()

    def visit(file: str, way: list[str]) -> None:
        if file in way:
            circle = way[way.index(file) :]
            first = circle.index(min(circle))
            circles.append([*circle[first:], *circle[:first], circle[first]])
        elif file not in done:
            for other in sorted(below.get(file, ())):
                visit(other, [*way, file])
            done.add(file)

    for file in sorted(below):
        visit(file, [])
    return circles


def main() -> None:
    """Print the faults; exit with 1 where there are any."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else C_SOURCES
    sources = {
        path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
        for path in root.rglob("*.[ch]")
    }
    faults = faults_of(sources)
    print("\n".join(faults) or f"{len(sources)} C files in {len(LAYERS)} layers: none includes up")
    sys.exit(1 if faults or not sources else 0)


if __name__ == "__main__":
    main()
