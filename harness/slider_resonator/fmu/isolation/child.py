"""The process of an isolated FMU, which runs tasks on one instance, or without an FMU on None.

`python -m slider_resonator.fmu.isolation.child FMU SECONDS FOLDER`, where FMU may be empty, reads
requests from its standard input and writes messages to its standard output, both pickled. The FMU
itself sees an empty standard input and runs in a folder in FOLDER; what it prints goes to standard
error. A call that takes longer than SECONDS ends the process, also inside native code, with a
traceback in FOLDER.
"""

import faulthandler
import os
import pickle
import sys
import traceback
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from typing import BinaryIO

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.isolation.process import TRACEBACK, Done, Outcome, Request
from slider_resonator.fmu.limits import MAX_WRITTEN
from slider_resonator.fmu.opening import open_fmu

if sys.platform != "win32":
    import resource


def main() -> None:
    """Instantiate the FMU and run tasks until there are no more requests."""
    path, limit, folder = sys.argv[1], float(sys.argv[2]), Path(sys.argv[3])
    # Standard input and output, moved to descriptors that the FMU does not know.
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    if sys.platform != "win32":
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (MAX_WRITTEN, MAX_WRITTEN))
    # Not with what the FMU prints, which may be endless, or look like a traceback.
    trace = (folder / TRACEBACK).open("w", encoding="utf-8")
    faulthandler.enable(trace)
    begin = partial(faulthandler.dump_traceback_later, limit, exit=True, file=trace)
    try:
        with ExitStack() as stack:
            fmu = stack.enter_context(open_fmu(path)) if path else None
            work = folder / "work"
            work.mkdir()
            os.chdir(work)
            begin()
            instance = stack.enter_context(instantiate(fmu)) if fmu is not None else None
            faulthandler.cancel_dump_traceback_later()
            _send(answers, Outcome())
            with suppress(EOFError):  # there are no more requests
                while True:
                    request: Request = pickle.load(requests)
                    begin()
                    message = _run(instance, request, answers)
                    faulthandler.cancel_dump_traceback_later()
                    _send(answers, message)
            begin()
    except HarnessError as error:
        _send(answers, Outcome(error=error))


def _run(instance: Instance | None, request: Request, answers: BinaryIO) -> Outcome:
    task, reports_progress = request
    if reports_progress:
        task = partial(task, progress=lambda *done: _send(answers, done))
    try:
        return Outcome(task(instance))
    except HarnessError as error:
        return Outcome(error=error)
    except Exception:
        return _internal()


def _send(answers: BinaryIO, message: Done | Outcome) -> None:
    try:
        content = pickle.dumps(message)
    except Exception:  # pickle raises anything
        content = pickle.dumps(_internal())
    answers.write(content)
    answers.flush()


def _internal() -> Outcome:
    """Return the outcome of a task that raised an unexpected exception, a programming error."""
    trace = traceback.format_exc()
    error = RuntimeError(f"a task failed in the process of the FMU:\n{trace}")
    return Outcome(error=error)


if __name__ == "__main__":
    main()
