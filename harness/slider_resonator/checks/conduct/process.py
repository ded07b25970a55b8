"""What an FMU does to the process that it shares with its host, and to others of its kind there.

It must leave folder, locale, environment, files and signals as they are, give memory back, and
serve several instances: in threads, freed in their runs, or thousands.
"""

import ctypes
import gc
import locale
import math
import mmap
import os
import signal
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, nullcontext, suppress
from ctypes import byref
from functools import partial
from itertools import count, repeat, takewhile
from pathlib import Path
from tempfile import TemporaryFile
from threading import stack_size
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

from slider_resonator.checks.conduct.findings import (
    SMOOTH,
    UNKNOWN,
    is_refused,
    other_value,
    values_to_vary,
)
from slider_resonator.checks.conduct.replays import Replay
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance, SavedState, instantiate
from slider_resonator.fmu.isolation.process import TIME_LIMIT, FmuDied, IsolatedFmu
from slider_resonator.fmu.opening import open_fmu

STEPS, STEP = 20, 1.1e-3
"""Steps (s) of a run."""


def process_faults(instance: Instance) -> list[str]:
    """Compare what a process has before and after a run of an instance in it.

    Nothing is compared on Windows, where a process does not have all of these.
    """
    if os.name != "posix":
        return []
    try:
        with IsolatedFmu(None, TIME_LIMIT) as process:
            return [*process.run(partial(_traces, path=instance.fmu.file))]
    except FmuDied as error:
        return [f"an instance and its run in a new process: {error}"]
    except (FmuError, OSError):  # there may be one instance, or no other process
        return []


def _traces(_: None, path: Path) -> list[str]:
    """Return what instances and their runs leave behind, in a process for this alone.

    What a process inherits is made known before, as one in which the FMU runs has started it.
    Instances may print on standard error when they are made, as some do.
    """
    for one in (signal.SIGINT, signal.SIGTERM):  # whose handlers are those of the host
        signal.signal(one, signal.default_int_handler)
    for one in (signal.SIGALRM, signal.SIGCHLD, signal.SIGHUP, signal.SIGUSR1, signal.SIGUSR2):
        signal.signal(one, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, [])
    os.umask(0o27)
    with suppress(AttributeError, OSError):  # which not all systems have
        os.sched_setaffinity(0, range(os.cpu_count() or 1))
    locale.setlocale(locale.LC_ALL, "C")
    os.environ.update(TZ="C", LC_ALL="C", LANG="C")  # which libraries may set
    flush = ctypes.CDLL(None).fflush
    with open_fmu(path) as fmu, TemporaryFile() as output, TemporaryFile() as errors:
        flush(None)
        os.dup2(output.fileno(), 1)
        os.dup2(errors.fileno(), 2)
        before = _shared(fmu.folder)
        with instantiate(fmu) as instance:
            flush(None)
            at_first = os.fstat(errors.fileno()).st_size
            with instance.explained():
                for phase in (0.0, 1.0):  # of a device that sticks, slides and flies
                    instance.start({"normal_amplitude": 1.8, "load": 0.02, "phase": phase})
                    _use(instance)
                instance.terminate()
            flush(None)
        if isinstance(instance.slave, FMU2Slave):
            ctypes.CDLL(instance.slave.dll._name)  # fmpy loads it in another folder
        after = _shared(fmu.folder)
        texts = (os.pread(output.fileno(), 80, 0), os.pread(errors.fileno(), 80, at_first))
    found = [
        f"print {text.decode('utf-8', 'replace')!r} where the host prints" for text in texts if text
    ]
    for what, value in before.items():
        if after[what] != value:
            sets = isinstance(value, set)
            how = sorted(value ^ after[what]) if sets else f"{value!r} becomes {after[what]!r}"
            found.append(f"change {what}: {how}")
    return [f"an instance and its run {one}" for one in found]


def _use(instance: Instance) -> None:
    """Step, make calls that are refused, go back to a state and switch logging."""
    for _ in range(3 * STEPS):
        instance.step_by(0.5 * STEP)
        instance.read(SMOOTH)
    is_refused(instance.call, "fmi2DoStep", instance.time, -STEP, True)
    is_refused(instance.set, {"load": math.nan})
    is_refused(instance.slave.getReal, [UNKNOWN])
    if instance.fmu.offers.canGetAndSetFMUstate:
        with SavedState.of(instance) as state:
            state.restore()
            if instance.fmu.offers.canSerializeFMUstate:
                state.transfer(instance)
    if isinstance(instance.slave, FMU2Slave):
        instance.call("fmi2SetDebugLogging", False, 0, None)


def _shared(folder: Path) -> dict[str, Any]:
    """Return what the process has, as far as this system tells, with the files in a folder."""
    library = ctypes.CDLL(None)
    library.setlocale.restype = ctypes.c_char_p
    variables = ctypes.POINTER(ctypes.c_char_p).in_dll(library, "environ")
    shared: dict[str, Any] = {
        "the current folder": str(Path.cwd()),
        "the files in it": {path.name for path in Path.cwd().iterdir()},
        "the locale": library.setlocale(locale.LC_ALL, None),
        "the files of the FMU": {str(path.relative_to(folder)) for path in folder.rglob("*")},
        "the environment": set(takewhile(bool, (variables[n] for n in count()))),
        "its priority": os.getpriority(os.PRIO_PROCESS, 0),
        "a timer": signal.getitimer(signal.ITIMER_REAL)[0] > 0.0,
    }
    with suppress(OSError):
        shared["the number of open files"] = len(os.listdir("/proc/self/fd"))
        lines = Path("/proc/self/status").read_text().splitlines()
        status = dict(line.split(":\t", 1) for line in lines)
        for key, what in (("SigIgn", "ignored"), ("SigCgt", "caught"), ("SigBlk", "blocked")):
            bits = int(status[key], 16)
            names = {one.name for one in signal.Signals if bits >> (one - 1) & 1}
            shared[f"the signals that are {what}"] = names
        shared["the number of threads"] = int(status["Threads"])
        shared["the mask of new files"] = status["Umask"].strip()
        shared["the processors it may use"] = os.sched_getaffinity(0)
    return shared


CYCLES, MANY = 16, 500
"""How often something is made and freed before memory is counted, and until it is counted again: a
sweep makes ten thousands of instances, a search by trial and return millions of states."""
PATIENCE = 2.0
"""Seconds after which a slow FMU has made enough of them."""
OF_INSTANCE, OF_STATE, OF_STEP, OF_REFUSAL = 512.0, 64.0, 8.0, 64.0
"""Bytes that each may leave. The host itself leaves some."""
MAPPED = 4 << 20
"""Bytes of memory that a process may map for its own purposes meanwhile."""


class _Counts(ctypes.Structure):
    """The result of mallinfo2, of which `hblkhd` is the fifth and `uordblks` the eighth count."""

    _fields_ = [("counts", ctypes.c_size_t * 10)]


def instance_leaks(instance: Instance) -> Iterator[str]:
    """Make, run and reset instances beside another, and free them; a step of each is refused.

    They are more than a small table of an FMU would hold, and each must do what the first does. An
    instance that is the only one of a process is reset alone.
    """
    once = instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess
    ends = set[tuple[float, ...]]()

    def use() -> None:
        beside = nullcontext(instance) if once else instantiate(instance.fmu)
        with beside as used, used.explained():
            for _ in range(5):
                used.start({})
                used.step_by(STEP)
                is_refused(used.call, "fmi2DoStep", used.time, -STEP, True)
            for _ in range(STEPS):
                used.step_by(STEP)
            ends.add(tuple(used.read(SMOOTH).values()))

    yield from _leaks("instance", use, OF_INSTANCE)
    if len(ends) > 1:
        yield "instances that are made later have other outputs"


def step_leaks(instance: Instance) -> Iterator[str]:
    """Set and read values and step; make calls that are refused."""
    instance.start({})

    def use() -> None:
        instance.set({"load": 0.01})
        instance.step_by(STEP)
        instance.read(("position", "friction_force"))

    def refuse() -> None:
        is_refused(instance.call, "fmi2DoStep", instance.time, -STEP, True)
        del instance.messages[:]

    yield from _leaks("step", use, OF_STEP, (200, 2000))
    yield from _leaks("refusal", refuse, OF_REFUSAL)


def state_leaks(instance: Instance) -> Iterator[str]:
    """Save states, set them, also in serialised form, and free them, with an instance in use."""
    serialises = instance.fmu.offers.canSerializeFMUstate

    def use() -> None:
        state = SavedState.of(instance)
        state.restore()
        if instance.fmu.runs_without_python:  # pythonfmu forgets the state that was there
            instance.call("fmi2GetFMUstate", byref(state.handle))
        if serialises:
            state.transfer(instance)
        state.free()

    yield from _leaks("state", use, OF_STATE)


def _leaks(
    what: str, use: Callable[[], None], allowed: float, numbers: Sequence[int] = (CYCLES, MANY)
) -> Iterator[str]:
    counts, done = list[tuple[int, int]](), 0
    for number in numbers:
        end, done = time.monotonic() + PATIENCE, 0
        while done < number and time.monotonic() < end:
            try:
                use()
            except (FMICallException, FmuError) as error:
                yield f"no more than {done} are possible of each {what}: {error}"
                return
            done += 1
        gc.collect()
        counts.append(_in_use())
    (before, mapped_before), (after, mapped) = counts
    left = max(after - before, mapped - mapped_before - MAPPED) / done
    if left > allowed:
        yield f"each {what} leaves {left:.0f} bytes behind"


def _in_use() -> tuple[int, int]:
    """Return the bytes that are allocated and mapped, 0 where the system does not tell."""
    try:
        mallinfo = ctypes.CDLL(None).mallinfo2
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    except (AttributeError, OSError, TypeError):
        return 0, 0
    mallinfo.restype = _Counts
    *_, mapped, _, _, used, _, _ = mallinfo().counts
    return used + mapped, pages * mmap.PAGESIZE


INSTANCES = 4
"""How many instances there are at a time, beside that of the scene."""


def crowd_faults(instance: Instance) -> Iterator[str]:
    """Compare each of several instances with the same run alone, to the last bit.

    Each has its own load and is stepped in a thread of its own. They are made beside one that is
    another device, and freed in the middle of its next run. Nothing is tried where a process can
    have only one.
    """
    if instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess:
        return
    steps, size = 200, 7e-4
    loads = [constant(0.01 * number) for number in range(INSTANCES)]
    courses = [schedule(steps * size, size, load=load) for load in loads]
    first, *alone = (Replay(instance, {}, course) for course in (courses[0], *courses))
    names = values_to_vary(instance)
    instance.start({name: other_value(name) for name in names})
    with ExitStack() as stack:
        try:
            others = [stack.enter_context(instantiate(instance.fmu)) for _ in courses]
        except FmuError as error:
            yield f"an instance beside {INSTANCES} others is refused: {error}"
            return
        stack.callback(stack_size, stack_size(1 << 20))  # of a thread, as on Windows
        with ThreadPoolExecutor(INSTANCES) as pool:
            together = [one.rows for one in pool.map(Replay, others, repeat({}), courses)]
            if together != [one.rows for one in alone]:
                yield "instances that step in threads have other outputs than alone"
        running = first.started()
        running.finish(end=steps // 2)
        for other in others:
            other.end(terminates=False)
    running.finish(steps // 2)
    if running.rows != first.rows:
        yield "an instance has other outputs after others are freed in the middle of their runs"
