"""The process between the harness and a program with foreign code, which ends all that it starts.

`python -I -S supervisor.py CONTROL MAX_MEMORY FOLDER PROGRAM ARGUMENT...` runs a program in a
session of its own, until it ends, CONTROL (a socket to the harness, by number) says so or closes,
or the program and all that it has started have more than MAX_MEMORY (bytes) in memory, or are more
than MAX_PROCESSES. Then it kills the program's group and every other process that the program has
left behind: on Linux those become its own children, whatever session they are in. At last it sends
how the program ended; if nobody listens any more, it removes FOLDER. Standard library only: it
starts in some milliseconds.
"""

import ctypes
import json
import os
import select
import shutil
import signal
import socket
import sys
import time
from collections.abc import Sequence
from contextlib import suppress

LINUX = sys.platform == "linux"
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36
POLL_INTERVAL = 0.1
"""Interval (s) at which the memory of the program itself is read."""
MAX_PROCESSES = 250
"""Largest number of processes, the program among them."""


def main() -> None:
    """Run the program and end it."""
    control = socket.socket(fileno=int(sys.argv[1]))
    max_memory, folder, command = int(sys.argv[2]), sys.argv[3], sys.argv[4:]
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
        signal.signal(number, signal.SIG_IGN)
    wakeup, wakeup_end = os.pipe()
    os.set_blocking(wakeup_end, False)
    signal.set_wakeup_fd(wakeup_end, warn_on_full_buffer=False)
    signal.signal(signal.SIGCHLD, lambda number, frame: None)
    _prctl(PR_SET_CHILD_SUBREAPER, 1)
    program = _start(command, control, (wakeup, wakeup_end))
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):  # the pipes of the program end with it
        os.dup2(nowhere, stream)
    report = _watch(program, control, wakeup, max_memory)
    _end_all(program)
    try:
        control.sendall(json.dumps(report).encode())
    except OSError:  # the harness has ended
        shutil.rmtree(folder, ignore_errors=True)


def _start(command: Sequence[str], control: socket.socket, closed: Sequence[int]) -> int:
    """Start the program, which is killed when this process ends, and return its number."""
    program = os.fork()
    if program:
        return program
    try:
        os.setsid()
        _prctl(PR_SET_PDEATHSIG, int(signal.SIGKILL))
        control.close()
        for descriptor in closed:
            os.close(descriptor)
        signal.set_wakeup_fd(-1)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
            signal.signal(number, signal.SIG_DFL)
        os.execv(command[0], list(command))
    except OSError as error:
        os.write(2, f"{command[0]}: {error.strerror}\n".encode())
    finally:
        os._exit(127)


def _watch(
    program: int, control: socket.socket, wakeup: int, max_memory: int
) -> dict[str, int | str]:
    """Return the program's exit `code` once it ends, or its `excess` over a limit."""
    next_count = time.monotonic()
    while True:
        readable, _, _ = select.select([control.fileno(), wakeup], [], [], POLL_INTERVAL)
        if wakeup in readable:
            os.read(wakeup, 4096)
        for ended, code in _reaped():
            if ended == program:
                return {"code": code}
        if control.fileno() in readable:
            return {}
        memory = _memory(program)
        if time.monotonic() >= next_count:
            processes = _descendants()
            if len(processes) > MAX_PROCESSES:
                return {"excess": f"{len(processes)} processes; must be at most {MAX_PROCESSES}"}
            if len(processes) > 1:
                memory = max(memory, sum(map(_share, processes)))
            next_count = time.monotonic() + 1.0
        if memory > max_memory:
            most = f"must be at most {max_memory >> 20} MiB (--max-memory)"
            return {"excess": f"{memory >> 20} MiB in memory; {most}"}


def _reaped() -> list[tuple[int, int]]:
    """Return the children that have ended, with their exit codes, as subprocess has them."""
    found = []
    with suppress(ChildProcessError):
        while True:
            process, status = os.waitpid(-1, os.WNOHANG)
            if process == 0:
                break
            found.append((process, os.waitstatus_to_exitcode(status)))
    return found


def _end_all(program: int) -> None:
    """Kill the program's group, then whatever becomes a child of this process."""
    deadline = time.monotonic() + 60.0  # many take their time on a busy machine
    while time.monotonic() < deadline:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(program, signal.SIGKILL)
        for process in _descendants():
            with suppress(ProcessLookupError, PermissionError):
                os.kill(process, signal.SIGKILL)
        _reaped()
        try:
            os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)
        except ChildProcessError:
            return
        time.sleep(0.01)


def _descendants() -> list[int]:
    """Return this process's children and theirs; none where there is no /proc."""
    parents: dict[int, int] = {}
    with suppress(OSError):
        for name in os.listdir("/proc"):
            if name.isdecimal():
                with suppress(OSError), open(f"/proc/{name}/stat", "rb") as file:
                    parents[int(name)] = int(file.read().rpartition(b")")[2].split()[1])
    found, new = set[int](), {os.getpid()}
    while new:
        new = {child for child, parent in parents.items() if parent in new} - found
        found |= new
    return list(found)


def _memory(process: int) -> int:
    """Return the bytes of a process that are in memory, 0 where there is no /proc."""
    with suppress(OSError), open(f"/proc/{process}/statm", "rb") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    return 0


def _share(process: int) -> int:
    """Return the bytes of a process that are in memory; what a fork shares counts once for all."""
    with suppress(OSError), open(f"/proc/{process}/smaps_rollup", "rb") as file:
        for line in file:
            if line.startswith(b"Pss:"):
                return int(line.split()[1]) * 1024
    return 0


def _prctl(option: int, value: int) -> None:
    if LINUX:
        ctypes.CDLL(None).prctl(option, ctypes.c_ulong(value), 0, 0, 0)


if __name__ == "__main__":
    main()
