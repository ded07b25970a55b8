"""Hosts that trap floating-point exceptions: resolved motion raises none that they trap."""

import pytest

from studies.hosts.driver_host import native_driver
from tests.native.scripts import CHOICES, script
from tests.native.toolchain import PROGRAMS, Binary, program, run
from tests.problems import PROBLEMS

PRELOADED = ("-shared", "-fPIC", "-Wl,--no-as-needed", "-lm")


@pytest.mark.slow
def test_no_invalid_operation_and_no_division_by_zero(
    product: Binary, tmp_path_factory: pytest.TempPathFactory
) -> None:
    trap = program(PROGRAMS / "trap.c", tmp_path_factory.mktemp("trap"), PRELOADED)
    command = [native_driver(), product.library, product.guid, "file:///nowhere"]
    died = {}
    for name, problem in PROBLEMS.items():
        for law, fidelity in ((law, fidelity) for law, fidelity in CHOICES if fidelity > 0):
            commands = script(problem.start_values, law, fidelity)
            done = run(command, commands, {"LD_PRELOAD": str(trap)})
            if done.returncode < 0:
                died[name, law, fidelity] = done.returncode
    assert not died, f"resolved motion must raise no trapped exception; signals: {died}"
