"""Trials in forked processes, some at a time."""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.child_environment import child_environment
from studies.mutants.attempt import Attempt, Attempted, Bench


class TrialServers:
    """Processes that fork trials; `attempt` may be called by as many threads at a time."""

    def __init__(self, servers: list[subprocess.Popen[bytes]]) -> None:
        self._idle: queue.SimpleQueue[subprocess.Popen[bytes]] = queue.SimpleQueue()
        for server in servers:
            self._idle.put(server)

    def attempt(self, attempt: Attempt) -> Attempted:
        """Try a variant of the FMU in a process of its own.

        Raises HarnessError when the forking process has ended.
        """
        server = self._idle.get()
        assert server.stdin is not None
        assert server.stdout is not None
        try:
            pickle.dump(attempt, server.stdin)
            server.stdin.flush()
            found: Attempted | Exception = pickle.load(server.stdout)
        except (OSError, EOFError) as error:
            raise HarnessError("the process that forks trials has ended") from error
        finally:
            self._idle.put(server)
        if isinstance(found, Exception):
            raise found
        return found


@contextmanager
def trial_servers(bench: Bench, jobs: int, folder: Path) -> Iterator[TrialServers]:
    """Start `jobs` processes that fork trials, with files in `folder`, for the block.

    An attempt that is at work at its end raises HarnessError. Raises HarnessError on a system
    without fork.
    """
    if not hasattr(os, "fork"):
        raise HarnessError(f"{sys.platform} cannot fork processes; must be Linux or macOS")
    file = folder / "bench.pickle"
    file.write_bytes(pickle.dumps(bench))
    servers: list[subprocess.Popen[bytes]] = []
    try:
        for _ in range(jobs):
            servers.append(
                subprocess.Popen(
                    [sys.executable, "-P", "-m", f"{__package__}.trial_server", str(file)],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    env=child_environment(str(folder), os.environ.get("PYTHONPATH", ""))
                    | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
                )
            )
        yield TrialServers(servers)
    finally:
        for server in servers:
            server.terminate()
        for server in servers:
            server.wait()
            for stream in (server.stdin, server.stdout):
                if stream is not None:
                    stream.close()
