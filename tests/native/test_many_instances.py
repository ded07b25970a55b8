from __future__ import annotations

import pytest

from tests.native.toolchain import PROGRAMS, Binary, program, run


@pytest.mark.slow
def test_memory_stays_flat_over_thousands_of_instances(
    product: Binary, tmp_path_factory: pytest.TempPathFactory
) -> None:
    made = program(PROGRAMS / "instances.c", tmp_path_factory.mktemp("instances"))
    done = run([made, product.library, product.guid, 30_000])
    assert done.returncode == 0, done.stdout + done.stderr
    early, late = (int(kilobytes) for kilobytes in done.stdout.split())
    assert early > 0, "resident memory is known"
    assert late - early < 256, (
        f"27 000 instances more must not take memory, not even the smallest block of malloc each: "
        f"{early} to {late} kB"
    )


@pytest.mark.slow
def test_8_instances_in_8_threads_give_the_numbers_that_they_give_alone(
    product: Binary, tmp_path_factory: pytest.TempPathFactory
) -> None:
    made = program(PROGRAMS / "threads.c", tmp_path_factory.mktemp("threads"))
    done = run([made, product.library, product.guid, 8, 5000])
    assert done.returncode == 0, done.stdout + done.stderr
