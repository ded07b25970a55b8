"""Compare two builds of an FMU: `python -m fmu_src.compare ONE.fmu OTHER.fmu`.

Exit code 0 where all files inside are equal, 1 otherwise. Binaries for macOS are left out: zig's
linker leaves random padding in them.
"""

import argparse
import zipfile
from pathlib import Path


def differing_files(one: Path, other: Path) -> list[str]:
    """Return the names of files inside that only one build has or that differ, in order."""
    first, second = _checksums(one), _checksums(other)
    return sorted(name for name in first | second if first.get(name) != second.get(name))


def main() -> int:
    """Print the names of files that differ and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m fmu_src.compare", description=__doc__)
    parser.add_argument("one", type=Path)
    parser.add_argument("other", type=Path)
    arguments = parser.parse_args()
    names = differing_files(arguments.one, arguments.other)
    for name in names:
        print(f"{arguments.one.name}: {name} differs")
    return 1 if names else 0


def _checksums(fmu: Path) -> dict[str, tuple[int, int]]:
    with zipfile.ZipFile(fmu) as archive:
        return {
            entry.filename: (entry.file_size, entry.CRC)
            for entry in archive.infolist()
            if "darwin" not in entry.filename
        }


if __name__ == "__main__":
    raise SystemExit(main())
