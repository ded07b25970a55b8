"""The platforms of FMI 2.0 for which native FMUs have binaries."""

from __future__ import annotations

import platform
import sys
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_src.building.build_error import BuildError


@dataclass(frozen=True)
class Platform:
    """`name` is FMI's; `targets` are zig's names of the processors in one file."""

    name: str
    suffix: str
    targets: tuple[str, ...]

    def binary(self, model: str) -> str:
        """Return the path of the binary in the FMU."""
        return f"binaries/{self.name}/{model}{self.suffix}"


PLATFORMS: dict[str, Platform] = {
    p.name: p
    for p in (
        # The C library of 2012: every later Linux loads it.
        Platform("linux64", ".so", ("x86_64-linux-gnu.2.17",)),
        Platform("win64", ".dll", ("x86_64-windows-gnu",)),
        # The first macOS that runs on both processors.
        Platform("darwin64", ".dylib", ("x86_64-macos.11.0", "aarch64-macos.11.0")),
    )
}

HOST = "host"
"""Stands for the platform of the machine that builds."""


def platforms_named(names: Sequence[str]) -> list[Platform]:
    """Return the platforms of these names, each once, in the order of PLATFORMS.

    `host` is a name too; no names means all. Raises BuildError for an unknown name.
    """
    chosen = {host_platform().name if name == HOST else name for name in names or PLATFORMS}
    unknown = sorted(chosen - PLATFORMS.keys())
    if unknown:
        raise BuildError(
            f"platform {unknown[0]!r} refused: must be one of {', '.join(PLATFORMS)}, {HOST}"
        )
    return [p for name, p in PLATFORMS.items() if name in chosen]


def host_platform() -> Platform:
    """Return the platform of this machine. Raises BuildError if FMI 2.0 has no name for it."""
    system = {"linux": "linux64", "win32": "win64", "darwin": "darwin64"}.get(sys.platform)
    machine = platform.machine().lower()
    if system is None or (system != "darwin64" and machine not in ("x86_64", "amd64")):
        raise BuildError(
            f"platform {HOST!r} refused: FMI 2.0 has no name for {sys.platform} on {machine}; "
            f"must be one of {', '.join(PLATFORMS)}"
        )
    return PLATFORMS[system]
