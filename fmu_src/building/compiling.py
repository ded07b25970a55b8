"""Compiling the C sources to the binaries of the native FMU."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from tempfile import TemporaryDirectory

from fmu_src.building.build_error import BuildError
from fmu_src.building.platforms import Platform
from fmu_src.building.universal_binary import universal_binary

FLAGS = (
    "-std=c99",
    "-O2",
    "-g0",
    "-fPIC",
    "-shared",
    "-fvisibility=hidden",
    "-ffp-contract=off",
    "-fno-math-errno",
)
"""For every compiler. Products and sums are not fused, so that platforms differ only as far as
their sine and exponential do."""

LINKING: dict[str, tuple[str, ...]] = {
    # Elsewhere it is an error anyway when a symbol is defined nowhere.
    "linux64": ("-s", "-Wl,-z,defs"),
    "win64": ("-s",),
    "darwin64": ("-Wl,-x",),
}
"""By platform: no symbols but those that hosts need."""


@dataclass(frozen=True)
class Compiler:
    """`command` is the start of its command line; one that `crosses` takes -target."""

    command: tuple[str, ...]
    description: str
    crosses: bool


def default_compiler() -> Compiler:
    """The C compiler of the package ziglang. Raises BuildError when it is not installed."""
    if importlib.util.find_spec("ziglang") is None:
        raise BuildError(
            "ziglang is not installed here; `make setup` installs it, or name a compiler for this "
            "machine with --compiler"
        )
    version = metadata.version("ziglang")
    return Compiler((sys.executable, "-m", "ziglang", "cc"), f"ziglang {version}", True)


def named_compiler(name: str) -> Compiler:
    """A compiler on the search path, or by its path. Raises BuildError when it is not there."""
    found = shutil.which(name)
    if found is None:
        raise BuildError(f"compiler {name!r} refused: it is not found; allowed is a C compiler")
    return Compiler((str(Path(found).absolute()),), Path(name).stem, False)


def compile_binaries(
    sources: Mapping[str, bytes],
    model: str,
    platforms: Sequence[Platform],
    compiler: Compiler,
    progress: Callable[[str], None],
) -> dict[str, bytes]:
    """Path in the FMU -> binary for each platform, from C files and headers (path -> bytes).

    Raises BuildError with what the compiler says.
    """
    jobs = [
        (p, target) for p in platforms for target in (p.targets if compiler.crosses else (None,))
    ]
    progress(
        f"compiling for {', '.join(p.name for p in platforms)} with {compiler.description}"
        + (" (the first time takes minutes)" if compiler.crosses else "")
    )

    def run(job: tuple[Platform, str | None]) -> bytes:
        binary = _compile(sources, model, job[0], job[1], compiler)
        progress(f"compiled for {job[1] or job[0].name}")
        return binary

    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        compiled = list(zip(jobs, pool.map(run, jobs), strict=True))
    binaries = {}
    for platform in platforms:
        parts = [binary for (p, _), binary in compiled if p is platform]
        binaries[platform.binary(model)] = parts[0] if len(parts) == 1 else universal_binary(parts)
    return binaries


def _compile(
    sources: Mapping[str, bytes],
    model: str,
    platform: Platform,
    target: str | None,
    compiler: Compiler,
) -> bytes:
    """One binary. The names that a compiler sees are relative, so that no path gets into it."""
    with TemporaryDirectory(prefix="slider_resonator_") as folder:
        for name, data in sources.items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        output = f"{model}{platform.suffix}"
        command = [*compiler.command, *(("-target", target) if target else ()), *FLAGS]
        command += [*LINKING[platform.name], "-o", output]
        command += [*sorted(name for name in sources if name.endswith(".c")), "-lm"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        binary = Path(folder, output)
        if done.returncode != 0 or not binary.is_file():
            raise BuildError(
                f"{compiler.description} could not compile for {target or platform.name}:\n"
                f"{done.stderr.strip()}"
            )
        return binary.read_bytes()
