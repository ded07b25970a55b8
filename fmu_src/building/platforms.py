"""The platforms for which native FMUs have binaries, by their names in each version of FMI."""

import platform
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_src.building.build_error import BuildError
from fmu_src.building.c_sources import FmiVersion


@dataclass(frozen=True)
class Platform:
    """A system, with one processor or several.

    `name` is FMI 2.0's if that has one; `targets` are zig's names of the processors, `tuples` FMI
    3.0's, in the same order. FMI 2.0 has one file for all of them, FMI 3.0 one for each.
    """

    name: str
    suffix: str
    targets: tuple[str, ...]
    tuples: tuple[str, ...]

    def binary(self, model: str) -> str:
        """Return the path of the binary in an FMU of FMI 2.0."""
        return f"binaries/{self.name}/{model}{self.suffix}"

    def binaries_3(self, model: str) -> tuple[str, ...]:
        """Return the paths of the binaries in an FMU of FMI 3.0, in the order of `targets`."""
        return tuple(f"binaries/{name}/{model}{self.suffix}" for name in self.tuples)


# The C library of 2012: every later Linux loads it.
_GLIBC = "gnu.2.17"

PLATFORMS: dict[str, Platform] = {
    p.name: p
    for p in (
        Platform("linux64", ".so", (f"x86_64-linux-{_GLIBC}",), ("x86_64-linux",)),
        Platform("win64", ".dll", ("x86_64-windows-gnu",), ("x86_64-windows",)),
        # The first macOS that runs on both processors.
        Platform(
            "darwin64",
            ".dylib",
            ("x86_64-macos.11.0", "aarch64-macos.11.0"),
            ("x86_64-darwin", "aarch64-darwin"),
        ),
    )
}
"""The platforms of FMI 2.0."""

AARCH64_LINUX = Platform("aarch64-linux", ".so", (f"aarch64-linux-{_GLIBC}",), ("aarch64-linux",))
"""FMI 2.0 has no name for it."""

PLATFORMS_3: dict[str, Platform] = {**PLATFORMS, AARCH64_LINUX.name: AARCH64_LINUX}
"""The platforms of FMI 3.0."""

HOST = "host"
"""Stands for the platform of the machine that builds."""


def platforms_of(version: FmiVersion) -> dict[str, Platform]:
    """Return the platforms of a version of FMI by name."""
    return PLATFORMS if version == "2.0" else PLATFORMS_3


def platforms_named(names: Sequence[str], version: FmiVersion = "2.0") -> list[Platform]:
    """Return the platforms of these names, each once, in the order of PLATFORMS.

    `host` is a name too; no names means all. Raises BuildError for a name that is unknown to this
    version of FMI.
    """
    known = platforms_of(version)
    chosen = {host_platform(version).name if name == HOST else name for name in names or known}
    unknown = sorted(chosen - known.keys())
    if unknown:
        raise BuildError(
            f"platform {unknown[0]!r} refused: must be one of {', '.join(known)}, {HOST}"
        )
    return [p for name, p in known.items() if name in chosen]


def host_platform(version: FmiVersion = "2.0") -> Platform:
    """Return the platform of this machine. Raises BuildError if FMI has no name for it."""
    known = platforms_of(version)
    system = {"linux": "linux64", "win32": "win64", "darwin": "darwin64"}.get(sys.platform)
    machine = platform.machine().lower()
    if version == "3.0" and system == "linux64" and machine in ("aarch64", "arm64"):
        return AARCH64_LINUX
    if system is None or (system != "darwin64" and machine not in ("x86_64", "amd64")):
        raise BuildError(
            f"platform {HOST!r} refused: FMI {version} has no name for {sys.platform} on "
            f"{machine}; must be one of {', '.join(known)}"
        )
    return known[system]
