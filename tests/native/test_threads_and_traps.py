"""Memory, threads and floating-point traps of hosts in C."""

from pathlib import Path

import pytest

from slider_resonator.stressing.random_cases import random_case
from studies.hosts.driver_host import native_driver
from tests.native.scripts import CHOICES, case_script, script
from tests.native.toolchain import PROGRAMS, Binary, program, run, sanitized_binary
from tests.problems import PROBLEMS

pytestmark = pytest.mark.slow


def output_of(source: str, folder: Path, product: Binary, *arguments: int) -> str:
    done = run([program(PROGRAMS / source, folder), product.library, product.guid, *arguments])
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_memory_stays_flat_over_thousands_of_instances(product: Binary, tmp_path: Path) -> None:
    early, late = map(int, output_of("instances.c", tmp_path, product, 30_000).split())
    assert early > 0, "resident memory is known"
    assert late - early < 256, (
        f"27 000 instances more must not take memory, not even the smallest block of malloc each: "
        f"{early} to {late} kB"
    )


def test_threads_give_the_numbers_of_instances_alone(product: Binary, tmp_path: Path) -> None:
    output_of("instances.c", tmp_path, product, 8, 5000)


RANDOM_CASES = 500


@pytest.mark.parametrize("compiler", ["that of the build", "gcc"])
def test_motion_raises_no_exception_that_hosts_trap(
    compiler: str, product: Binary, tmp_path: Path
) -> None:
    """No invalid operation and no division by zero."""
    binary = product if compiler != "gcc" else sanitized_binary(tmp_path / "gcc", ("-O2",))
    preloaded = ("-shared", "-fPIC", "-Wl,--no-as-needed", "-lm")
    trap = program(PROGRAMS / "trap.c", tmp_path, preloaded)
    command = [native_driver(), binary.library, binary.guid, "file:///nowhere"]
    runs = {
        f"{name}, law {choice[0]}, fidelity {choice[1]}": script(problem.start_values, *choice)
        for name, problem in PROBLEMS.items()
        for choice in CHOICES
    }
    runs |= {f"random device {n}": case_script(random_case(7, n)) for n in range(RANDOM_CASES)}
    trapping = {"LD_PRELOAD": str(trap)}
    died = [
        name for name, commands in runs.items() if run(command, commands, trapping).returncode < 0
    ]
    assert not died, f"ended by signals: {died}"
