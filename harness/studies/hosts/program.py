"""Programs of hosts, which load FMUs: supervised, with a time limit."""

import os
import subprocess
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from slider_resonator.fmu.isolation.supervised import Supervised


def run_program(
    command: Sequence[str],
    folder: Path,
    printed: Path,
    time_limit: float,
    *,
    script: Path | None = None,
    errors: Path | None = None,
) -> str:
    """Run a program until it ends or `time_limit` (s) has passed; return how it ended.

    Its temporary files go to `folder`, what it prints to the file `printed`: a pipe would stay open
    as long as any process that it started. `script` is its input, if any; with `errors` its
    standard error goes to a file of its own.
    """
    with ExitStack() as stack:
        given = stack.enter_context(Path(script or os.devnull).open("rb"))
        log = stack.enter_context(printed.open("wb"))
        stderr = subprocess.STDOUT if errors is None else stack.enter_context(errors.open("wb"))
        # Hosts leave what they have unpacked where it is when an FMU fails.
        program = Supervised(command, folder, stdin=given, stdout=log, stderr=stderr)
        try:
            in_time = program.wait(time_limit)
        finally:
            ending = program.end()
    if ending.excess:
        return f"was ended: it had {ending.excess}"
    return f"ended with {ending.code}" if in_time else f"was ended after {time_limit:g} s"
