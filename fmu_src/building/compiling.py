"""Compile the C sources to the binaries of a native FMU."""

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
from platform import machine

from fmu_src.building.build_error import BuildError
from fmu_src.building.build_folder import build_folder
from fmu_src.building.c_sources import FmiVersion, c_files
from fmu_src.building.cache import cached
from fmu_src.building.platforms import Platform
from fmu_src.building.universal_binary import universal_binary

FLAGS = (
    "-std=c99",
    "-O3",
    "-g0",
    "-fPIC",
    "-shared",
    "-fvisibility=hidden",
    "-ffp-contract=off",
    "-fno-math-errno",
)
"""For every compiler. Without fused products and sums, and with elementary functions of their own,
the sources give the same bits on every platform."""

LINKING: dict[str, tuple[str, ...]] = {
    # The other linkers report undefined symbols by default.
    ".so": ("-s", "-Wl,-z,defs"),
    ".dll": ("-s",),
    ".dylib": ("-Wl,-x",),
}
"""Linker flags by the suffix of the library: strip the symbols that hosts do not need."""


@dataclass(frozen=True)
class Compiler:
    """`command` begins its command line; a cross-compiler (`crosses`) takes -target."""

    command: tuple[str, ...]
    description: str
    crosses: bool


def default_compiler() -> Compiler:
    """Return the C compiler of the package ziglang. Raises BuildError if it is not installed."""
    if importlib.util.find_spec("ziglang") is None:
        raise BuildError(
            "ziglang is not installed here; `make setup` installs it, or name a compiler for this "
            "machine with --compiler"
        )
    version = metadata.version("ziglang")
    return Compiler((sys.executable, "-m", "ziglang", "cc"), f"ziglang {version}", True)


def named_compiler(name: str) -> Compiler:
    """Return a compiler by its name or path. Raises BuildError if it is not found."""
    found = shutil.which(name)
    if found is None:
        raise BuildError(f"compiler {name!r} refused: it is not found; must be a C compiler")
    return Compiler((str(Path(found).absolute()),), Path(name).stem, False)


def compile_binaries(
    sources: Mapping[str, str],
    model: str,
    platforms: Sequence[Platform],
    compiler: Compiler,
    progress: Callable[[str], None],
    version: FmiVersion = "2.0",
) -> dict[str, bytes]:
    """Compile C files and headers (path -> text); return path in the FMU -> binary.

    Processors of one platform share a file in FMI 2.0, and have one each in FMI 3.0.

    Raises BuildError with the compiler's messages.
    """
    jobs = [
        (p, target) for p in platforms for target in (p.targets if compiler.crosses else (None,))
    ]
    progress(
        f"compiling for {', '.join(p.name for p in platforms)} with {compiler.description}"
        + (" (the first time takes minutes)" if compiler.crosses else "")
    )

    def run(job: tuple[Platform, str | None]) -> bytes:
        platform, target = job
        flags = (*FLAGS, *LINKING[platform.suffix])
        output = f"{model}{platform.suffix}"
        binary = compile_binary(sources, output, target, flags, compiler)
        progress(f"compiled for {target or platform.name}")
        return binary

    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        compiled = list(zip(jobs, pool.map(run, jobs), strict=True))
    binaries: dict[str, bytes] = {}
    for platform in platforms:
        parts = [binary for (p, _), binary in compiled if p is platform]
        if version == "3.0":
            binaries |= dict(zip(_paths_3(platform, model, compiler), parts, strict=True))
            continue
        binaries[platform.binary(model)] = parts[0] if len(parts) == 1 else universal_binary(parts)
    return binaries


def _paths_3(platform: Platform, model: str, compiler: Compiler) -> list[str]:
    """Return the paths of what `compiler` makes for a platform of FMI 3.0."""
    paths = dict(zip(platform.tuples, platform.binaries_3(model), strict=True))
    if compiler.crosses:
        return list(paths.values())
    # A compiler of this machine makes binaries for its processor.
    arm = machine().lower() in ("aarch64", "arm64")
    return [p for name, p in paths.items() if name.startswith("aarch64") == arm]


def compile_binary(
    sources: Mapping[str, str],
    output: str,
    target: str | None,
    flags: Sequence[str],
    compiler: Compiler,
) -> bytes:
    """Return the file `output`, compiled from C files and headers (path -> text).

    That of the last build is taken where all that it depends on is the same. Raises BuildError with
    the compiler's messages.
    """
    # Relative names: the binary contains no path of this machine.
    names = c_files(sources)
    arguments = [*(("-target", target) if target else ()), *flags, "-o", output, *names, "-lm"]

    def make() -> bytes:
        with build_folder(target, sources) as folder:
            command = [*compiler.command, *arguments]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
            binary = folder / output
            if done.returncode != 0 or not binary.is_file():
                raise BuildError(
                    f"{compiler.description} could not compile for {target or 'this machine'}:\n"
                    f"{done.stderr.strip()}"
                )
            return binary.read_bytes()

    if target is None:
        return make()  # by a compiler that may change without another name
    origin = repr((compiler.description, arguments, sorted(sources.items())))
    return cached(f"{target}-{output}", origin.encode(), make)
