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
from contextlib import ExitStack, chdir, contextmanager, suppress
from functools import partial
from itertools import repeat
from pathlib import Path
from tempfile import TemporaryDirectory, TemporaryFile
from threading import current_thread, main_thread, stack_size

from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.findings import is_refused
from slider_resonator.checks.conduct.replays import Replay
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance, SavedState, instantiate

STEPS, STEP = 20, 1.1e-3
"""Steps (s) of a run."""
STREAMS = {1: "output", 2: "error"}
"""Standard streams. An FMU may print on the latter when it is instantiated, as some do."""
SHOWN = 80
"""Bytes that are shown of what an FMU prints."""
HOST_SIGNALS = (signal.SIGINT, signal.SIGTERM)
"""Signals whose handlers are those of the host."""
WATCHED = (*HOST_SIGNALS, signal.SIGSEGV, signal.SIGFPE, signal.SIGABRT)
"""Those that are compared: hosts report crashes by some."""
ENVIRONMENT = ("TZ", "LC_ALL", "LANG")
"""Variables of the environment that libraries may set."""


def process_faults(instance: Instance) -> Iterator[str]:
    """Compare folder, locale, environment, open files and signals before and after a run.

    All are first made those of a new process: the FMU may have changed them before. Nothing is
    compared on Windows, where a process does not have all of these.
    """
    if os.name != "posix":
        return
    for stream, name in STREAMS.items():
        try:
            os.fstat(stream)
        except OSError:
            yield f"standard {name} is closed"
            return
    instance.renew()
    with _as_in_a_new_process():
        before = _shared()
        with instance.explained():
            with _printed(1) as at_first:
                instance.renew()
            with _printed(*STREAMS) as in_run:
                instance.start({})
                instance.step_by(STEP)
                instance.terminate()
        instance.renew()  # an instance may keep a file open
        after = _shared()
    for what, value in before.items():
        if after[what] != value:
            yield f"an instance and its run change {what}: {value!r} becomes {after[what]!r}"
    for text in at_first + in_run:
        yield f"an instance and its run print {text!r} where the host prints"


@contextmanager
def _as_in_a_new_process() -> Iterator[None]:
    """Give the process an empty folder, and other values that are known, for the block."""
    # Python lets the main thread alone set handlers.
    signals = HOST_SIGNALS if current_thread() is main_thread() else ()
    handlers = {one: signal.signal(one, signal.default_int_handler) for one in signals}
    environment = {name: os.environ.get(name) for name in ENVIRONMENT}
    language = locale.setlocale(locale.LC_ALL)
    try:
        with TemporaryDirectory() as folder, chdir(folder):
            locale.setlocale(locale.LC_ALL, "C")
            os.environ.update(dict.fromkeys(ENVIRONMENT, "C"))
            yield
    finally:
        locale.setlocale(locale.LC_ALL, language)
        for name, value in environment.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value
        for one, handler in handlers.items():
            signal.signal(one, handler)


@contextmanager
def _printed(*streams: int) -> Iterator[list[str]]:
    """Yield the beginnings of what the block prints on standard streams, at its end."""
    library = ctypes.CDLL(None)
    texts: list[str] = []
    with ExitStack() as stack:
        files = []
        for stream in streams:
            files.append(stack.enter_context(TemporaryFile()))
            kept = os.dup(stream)
            stack.callback(os.close, kept)
            stack.callback(os.dup2, kept, stream)
            library.fflush(None)
            os.dup2(files[-1].fileno(), stream)
        stack.callback(library.fflush, None)
        yield texts
        library.fflush(None)
        for file in files:
            file.seek(0)
            if text := file.read(SHOWN):
                texts.append(text.decode("utf-8", "replace"))


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


CYCLES = 16
"""How often something is made and freed while memory is counted, after as many times before."""
OF_INSTANCE, OF_STATE = 1024.0, 512.0
"""Bytes that each may leave: a sweep makes ten thousands of instances, a search by trial and return
millions of states. The host itself leaves some."""


class _Counts(ctypes.Structure):
    """The result of mallinfo2, of which `hblkhd` is the fifth and `uordblks` the eighth count."""

    _fields_ = [("counts", ctypes.c_size_t * 10)]


def instance_leaks(instance: Instance) -> Iterator[str]:
    """Make, run, reset and run instances, and free them; a step of each is refused.

    An instance that is the only one of a process is reset alone.
    """
    once = instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess

    def use() -> None:
        with instance.explained():
            if not once:
                instance.end(terminates=False)
            instance.start({})
            instance.step_by(STEP)
            is_refused(partial(instance.call, "fmi2DoStep", instance.time, -STEP, True))
            instance.start({})
            for _ in range(STEPS):
                instance.step_by(STEP)

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
    counts: list[int] = []
    for _ in range(2):
        for _ in range(CYCLES):
            use()
        gc.collect()
        counts += _in_use()
    left = (counts[-1] - counts[0]) / CYCLES if counts else 0.0
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
RESETS, MADE = 3000, 500
"""How often an instance is reset, and how many are made after it: a sweep makes as many."""
PATIENCE = 5.0
"""Seconds for each."""


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


def life_faults(instance: Instance) -> Iterator[str]:
    """Reset an instance, and make and free others, more often than a small table would allow.

    As often as that goes in a while: an FMU may be slow.
    """
    attempts: list[tuple[str, Callable[[], object], int]]
    attempts = [("resets of an instance", partial(instance.call, "fmi2Reset"), RESETS)]
    if not instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess:
        attempts.append(("instances beside another", lambda: Instance(instance.fmu).end(), MADE))
    for what, attempt, count in attempts:
        began, done = time.monotonic(), 0
        try:
            while done < count and time.monotonic() < began + PATIENCE:
                attempt()
                done += 1
        except (FMICallException, FmuError) as error:
            yield f"no more than {done} {what} are possible: {error}"
