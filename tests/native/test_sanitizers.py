"""AddressSanitizer, UndefinedBehaviorSanitizer, ThreadSanitizer and memcheck on the C sources."""

from pathlib import Path

import pytest

from studies.hosts.compiler import SOURCES
from tests.native.scripts import CHOICES, devices, script
from tests.native.toolchain import FAULT, PROGRAMS, Binary, needed, program, run, sanitized_binary

pytestmark = pytest.mark.interop

KEEP = ("-O1", "-g", "-fno-omit-frame-pointer")
MEMORY = (*KEEP, "-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all")
THREADS = (*KEEP, "-fsanitize=thread")
SPEAK_UP = {
    "ASAN_OPTIONS": f"exitcode={FAULT}",
    "UBSAN_OPTIONS": f"exitcode={FAULT}:print_stacktrace=1",
    "TSAN_OPTIONS": f"exitcode={FAULT}",
}
MEMCHECK = (
    "--quiet",
    f"--error-exitcode={FAULT}",
    "--leak-check=full",
    "--show-leak-kinds=definite,indirect,possible",
    "--errors-for-leak-kinds=definite,indirect,possible",
)
REFUSED = 1


@pytest.fixture(scope="module")
def memory_checked(tmp_path_factory: pytest.TempPathFactory) -> Binary:
    return sanitized_binary(tmp_path_factory.mktemp("memory_checked"), MEMORY)


@pytest.mark.parametrize(("law", "fidelity"), CHOICES)
def test_no_device_makes_undefined_behaviour(
    memory_checked: Binary, tmp_path: Path, law: int, fidelity: int
) -> None:
    driver = program(SOURCES / "driver.c", tmp_path, MEMORY)
    command = [driver, memory_checked.library, memory_checked.guid, "file:///"]
    ran = 0
    for name, values in devices().items():
        done = run(command, script(values, law, fidelity), SPEAK_UP)
        assert done.returncode in (0, REFUSED), f"{name}: {done.stderr}"
        if done.returncode == REFUSED:
            assert "refused" in done.stderr, f"{name}: {done.stderr}"
        assert "nan" not in done.stdout, f"{name} gives NaN: {done.stdout}"
        ran += done.returncode == 0
    assert ran > 0.8 * len(devices()), f"most devices must run, not be refused: {ran} ran"


@pytest.mark.parametrize(
    ("source", "arguments"),
    [
        ("fuzz.c", (7, 200_000)),
        ("fuzz3.c", (1, 100_000, 30.0)),
        ("instances.c", (600,)),
        ("states.c", (1, 2_000, 30.0)),
    ],
)
def test_no_call_makes_undefined_behaviour_or_leaves_memory(
    memory_checked: Binary, tmp_path: Path, source: str, arguments: tuple[float, ...]
) -> None:
    is_fmi_3 = source == "fuzz3.c"
    binary = sanitized_binary(tmp_path / "3", MEMORY, "3.0") if is_fmi_3 else memory_checked
    caller = program(PROGRAMS / source, tmp_path, MEMORY)
    done = run([caller, binary.library, binary.guid, *arguments], environment=SPEAK_UP)
    assert done.returncode == 0, done.stdout + done.stderr


def test_8_instances_in_8_threads_do_not_race(tmp_path: Path) -> None:
    binary = sanitized_binary(tmp_path, THREADS)
    threads = program(PROGRAMS / "instances.c", tmp_path, THREADS)
    done = run([threads, binary.library, binary.guid, 8, 300], environment=SPEAK_UP)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(("law", "fidelity"), CHOICES)
def test_memcheck_passes_the_shipped_binary(
    product: Binary, tmp_path: Path, law: int, fidelity: int
) -> None:
    valgrind = needed("valgrind", "it is memcheck")
    driver = program(SOURCES / "driver.c", tmp_path)
    command = [valgrind, *MEMCHECK, driver, product.library, product.guid, "file:///"]
    done = run(command, script({}, law, fidelity))
    assert done.returncode == 0, done.stderr
    assert done.stderr == "", "neither valgrind nor the FMU may report anything"
