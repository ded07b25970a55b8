"""What an FMU does to the process that it shares with its host, and to others of its kind there.

It must leave folder, locale, environment, files and signals as they are, give memory back, and
serve several instances: in threads, freed in their runs, or thousands.
"""

import ctypes
import gc
import locale
import os
import signal
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, nullcontext, suppress
from functools import partial
from itertools import repeat
from pathlib import Path
from tempfile import TemporaryFile
from threading import stack_size

from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.findings import is_refused
from slider_resonator.checks.conduct.replays import Replay
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance, SavedState, instantiate
from slider_resonator.fmu.isolation.process import TIME_LIMIT, FmuDied, IsolatedFmu
from slider_resonator.fmu.opening import open_fmu

STEPS, STEP = 20, 1.1e-3
"""Steps (s) of a run."""
SHOWN = 80
"""Bytes that are shown of what an FMU prints."""
HOST_SIGNALS = (signal.SIGINT, signal.SIGTERM)
"""Signals whose handlers are those of the host."""
WATCHED = (*HOST_SIGNALS, signal.SIGSEGV, signal.SIGFPE, signal.SIGABRT)
"""Those that are compared: hosts report crashes by some."""
ENVIRONMENT = ("TZ", "LC_ALL", "LANG")
"""Variables of the environment that libraries may set."""


def process_faults(instance: Instance) -> list[str]:
    """Compare folder, locale, environment, open files and signals before and after a run.

    Nothing is compared on Windows, where a process does not have all of these.
    """
    if os.name != "posix":
        return []
    try:
        with IsolatedFmu(None, TIME_LIMIT) as process:
            found: list[str] = process.run(partial(_traces, path=instance.fmu.file))
            return found
    except FmuDied as error:
        return [f"an instance and its run in a new process: {error}"]
    except (FmuError, OSError):  # there may be one instance, or no other process
        return []


def _traces(_: None, path: Path) -> list[str]:
    """Return what instances and their runs leave behind, in a process for this alone.

    They may print on standard error when they are instantiated, as some do.
    """
    for one in HOST_SIGNALS:
        signal.signal(one, signal.default_int_handler)
    locale.setlocale(locale.LC_ALL, "C")
    os.environ.update(dict.fromkeys(ENVIRONMENT, "C"))
    flush = ctypes.CDLL(None).fflush
    with open_fmu(path) as fmu, TemporaryFile() as output, TemporaryFile() as errors:
        flush(None)
        os.dup2(output.fileno(), 1)
        os.dup2(errors.fileno(), 2)
        before = _shared()
        with instantiate(fmu) as instance:
            flush(None)
            at_first = os.fstat(errors.fileno()).st_size
            with instance.explained():
                for attempt in range(2):
                    instance.start({"phase": float(attempt)})
                    instance.step_by(STEP)
                instance.terminate()
            flush(None)
        after = _shared()
        texts = (os.pread(output.fileno(), SHOWN, 0), os.pread(errors.fileno(), SHOWN, at_first))
    found = [
        f"an instance and its run change {what}: {value!r} becomes {after[what]!r}"
        for what, value in before.items()
        if after[what] != value
    ]
    return found + [
        f"an instance and its run print {text.decode('utf-8', 'replace')!r} where the host prints"
        for text in texts
        if text
    ]


def _shared() -> dict[str, object]:
    """Return what the process has, as far as this system tells."""
    library = ctypes.CDLL(None)
    library.setlocale.restype = library.getenv.restype = ctypes.c_char_p
    shared: dict[str, object] = {
        "the current folder": str(Path.cwd()),
        "the files in it": sorted(path.name for path in Path.cwd().iterdir()),
        "the locale": library.setlocale(locale.LC_ALL, None),
        "the environment": {name: library.getenv(name.encode()) for name in ENVIRONMENT},
    }
    with suppress(OSError):
        shared["the number of open files"] = len(os.listdir("/proc/self/fd"))
        status = dict(
            line.split(":\t", 1) for line in Path("/proc/self/status").read_text().splitlines()
        )
        for key, what in (("SigIgn", "ignored"), ("SigCgt", "caught")):
            bits = int(status[key], 16)
            shared[f"the signals that are {what}"] = [
                one.name for one in WATCHED if bits >> (one - 1) & 1
            ]
    return shared


CYCLES, MANY = 16, 500
"""How often something is made and freed before memory is counted, and until it is counted again: a
sweep makes ten thousands of instances, a search by trial and return millions of states."""
RESETS = 5
"""How often each instance is started."""
PATIENCE = 2.0
"""Seconds after which a slow FMU has made enough of them."""
OF_INSTANCE, OF_STATE = 1024.0, 512.0
"""Bytes that each may leave. The host itself leaves some."""


class _Counts(ctypes.Structure):
    """The result of mallinfo2, of which `hblkhd` is the fifth and `uordblks` the eighth count."""

    _fields_ = [("counts", ctypes.c_size_t * 10)]


def instance_leaks(instance: Instance) -> Iterator[str]:
    """Make, run and reset instances beside another, and free them; a step of each is refused.

    They are more than a small table of an FMU would hold. An instance that is the only one of a
    process is reset alone.
    """
    once = instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess

    def use() -> None:
        beside = nullcontext(instance) if once else instantiate(instance.fmu)
        with beside as used, used.explained():
            for _ in range(RESETS):
                used.start({})
                used.step_by(STEP)
                is_refused(partial(used.call, "fmi2DoStep", used.time, -STEP, True))
            for _ in range(STEPS):
                used.step_by(STEP)

    yield from _leaks("instance", use, OF_INSTANCE)


def state_leaks(instance: Instance) -> Iterator[str]:
    """Save states, set them, also in serialised form, and free them, with an instance in use."""
    serialises = instance.fmu.offers.canSerializeFMUstate

    def use() -> None:
        state = SavedState.of(instance)
        state.restore()
        if serialises:
            state.transfer(instance)
        state.free()

    yield from _leaks("state", use, OF_STATE)


def _leaks(what: str, use: Callable[[], None], allowed: float) -> Iterator[str]:
    counts, done = list[int](), 0
    for count in (CYCLES, MANY):
        end, done = time.monotonic() + PATIENCE, 0
        while done < count and time.monotonic() < end:
            try:
                use()
            except (FMICallException, FmuError) as error:
                yield f"no more than {done} can be made and freed of each {what}: {error}"
                return
            done += 1
        gc.collect()
        counts += _in_use()
    left = (counts[-1] - counts[0]) / done if counts else 0.0
    if left > allowed:
        yield f"each {what} that is made and freed leaves {left:.0f} bytes behind"


def _in_use() -> list[int]:
    """Return the bytes that are allocated, nothing where the C library does not tell."""
    try:
        count = ctypes.CDLL(None).mallinfo2
    except (AttributeError, OSError, TypeError):
        return []
    count.restype = _Counts
    *_, mapped, _, _, used, _, _ = count().counts
    return [used + mapped]


INSTANCES = 4
"""How many instances there are at a time, beside that of the scene."""
COURSE = 200, 7e-4
"""Number and size (s) of the steps of each."""
STACK = 1 << 20
"""Bytes of the stack of a thread, as on Windows."""


def crowd_faults(instance: Instance) -> Iterator[str]:
    """Compare each of several instances with the same run alone, to the last bit.

    Each has its own load and is stepped in a thread of its own; all are freed in their runs.
    Nothing is tried where a process can have only one.
    """
    if instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess:
        return
    steps, size = COURSE
    courses = [
        schedule(steps * size, (size,), {}, False, load=constant(0.01 * number))
        for number in range(INSTANCES)
    ]
    alone = [Replay(instance, {}, course).rows for course in courses]
    with ExitStack() as stack:
        try:
            others = [stack.enter_context(instantiate(instance.fmu)) for _ in courses]
        except FmuError as error:
            yield f"an instance beside {INSTANCES} others is refused: {error}"
            return
        stack.callback(stack_size, stack_size(STACK))  # of threads of hosts that save memory
        with ThreadPoolExecutor(INSTANCES) as pool:
            together = [one.rows for one in pool.map(Replay, others, repeat({}), courses)]
            if together != alone:
                yield "instances that step in threads have other outputs than alone"
        for other in others:
            other.end(terminates=False)
    if Replay(instance, {}, courses[0]).rows != alone[0]:
        yield "an instance has other outputs after others are freed in the middle of their runs"
