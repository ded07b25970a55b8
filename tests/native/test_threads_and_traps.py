from pathlib import Path

import pytest

from tests.native.toolchain import PROGRAMS, Binary, program, run

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
    output_of("threads.c", tmp_path, product, 8, 5000)
