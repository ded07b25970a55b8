"""The FMU of FMI 3.0 on 64-bit ARM, under qemu: the six cases of table 1, by a host in C."""

import platform
import shutil
from collections.abc import Sequence
from pathlib import Path

import pytest

from fmu_src.building.native_fmu import build_native_3
from fmu_src.building.platforms import AARCH64_LINUX, HOST, host_platform
from fmu_src.python.slider_component.variables import VARIABLES
from studies.hosts.compiler import compile_program, native_compiler, zig_compiler
from studies.hosts.job import HostAnswer, describe
from studies.hosts.runs import compare
from tests.native.toolchain import Binary, run, unpacked_binary

pytestmark = [
    pytest.mark.interop,
    pytest.mark.skipif(platform.system() != "Linux", reason="qemu runs binaries of Linux on Linux"),
]

SOURCE = Path(__file__).parent / "c" / "driver_3.c"
HEADERS = ("-Wno-strict-prototypes",)
"""The standard's own header declares two types of functions without parameters."""

QEMU = ("qemu-aarch64", "-L", "/usr/aarch64-linux-gnu")
OUTPUTS = [v.name for v in VARIABLES if v.causality == "output"]


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("aarch64")
    return build_native_3(folder, platforms=[AARCH64_LINUX.name, HOST])


@pytest.fixture(scope="module")
def drivers(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The host for this machine, and for ARM."""
    folder = tmp_path_factory.mktemp("drivers")
    target = [*zig_compiler(), "-target", AARCH64_LINUX.targets[0]]
    return (
        compile_program(native_compiler(), SOURCE, folder / "here", HEADERS),
        compile_program(target, SOURCE, folder / "arm", ["-g0", "-s", "-ldl", *HEADERS]),
    )


def rows_of(fmu: Path, binary: Binary, host: Sequence[object], case: tuple[int, int]) -> list[str]:
    description = describe(str(fmu))
    chosen = description.refer(["friction_law", "fidelity"])
    asked = (binary.guid, *case, *chosen, *description.refer(OUTPUTS))
    done = run([*host, binary.library, *asked])
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@pytest.mark.parametrize("case", [(law, fidelity) for law in (0, 1) for fidelity in (2, 1, 0)])
def test_arm_gives_the_numbers_of_this_machine(
    fmu: Path, drivers: tuple[Path, Path], tmp_path: Path, case: tuple[int, int]
) -> None:
    assert shutil.which(QEMU[0]), f"{QEMU[0]}: not found; `make hosts` installs it"
    here, arm = drivers
    native, foreign = (
        unpacked_binary(fmu, tmp_path, *platform.tuples)
        for platform in (host_platform("3.0"), AARCH64_LINUX)
    )
    *ours, our_events = rows_of(fmu, native, [here], case)
    *theirs, their_events = rows_of(fmu, foreign, [*QEMU, arm], case)
    assert our_events == their_events
    assert int(our_events) > 0 or case[1] == 0
    expected, found = ([[*map(float, line.split())] for line in r] for r in (ours, theirs))
    assert compare(expected, HostAnswer(found)).passed
