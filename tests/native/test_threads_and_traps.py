"""Memory, threads and floating-point traps of hosts in C."""

from pathlib import Path

import pytest

from studies.hosts.driver_host import native_driver
from tests.native.scripts import CHOICES, script
from tests.native.toolchain import PROGRAMS, Binary, program, run
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


def test_resolved_motion_raises_no_exception_that_hosts_trap(
    product: Binary, tmp_path: Path
) -> None:
    """No invalid operation and no division by zero."""
    preloaded = ("-shared", "-fPIC", "-Wl,--no-as-needed", "-lm")
    trap = program(PROGRAMS / "trap.c", tmp_path, preloaded)
    command = [native_driver(), product.library, product.guid, "file:///nowhere"]
    trapping = {"LD_PRELOAD": str(trap)}
    died = {}
    for name, problem in PROBLEMS.items():
        for law, fidelity in CHOICES:
            commands = script(problem.start_values, law, fidelity)
            if fidelity > 0 and (code := run(command, commands, trapping).returncode) < 0:
                died[name, law, fidelity] = code
    assert not died, f"ended by signals: {died}"
