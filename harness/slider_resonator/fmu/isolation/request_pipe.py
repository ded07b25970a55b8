"""The pipe to the process of an FMU, written with a deadline."""

from __future__ import annotations

import os
import select
import sys
from contextlib import suppress
from time import monotonic
from typing import IO


class RequestPipe:
    """A pipe whose writer does not wait for ever for a reader that has stopped."""

    def __init__(self, pipe: IO[bytes]) -> None:
        self._pipe = pipe
        if sys.platform != "win32":
            os.set_blocking(pipe.fileno(), False)

    def __enter__(self) -> RequestPipe:
        return self

    def __exit__(self, *error: object) -> None:
        with suppress(OSError):  # the process has closed its end of the pipe
            self.close()

    def close(self) -> None:
        """Say that there are no more requests."""
        self._pipe.close()

    def write(self, content: bytes, seconds: float) -> None:
        """Write all; OSError where the reader has ended or does not read for that long."""
        if sys.platform == "win32":
            self._pipe.write(content)
            self._pipe.flush()
            return
        left, deadline = memoryview(content), monotonic() + seconds
        while left:
            _, ready, _ = select.select([], [self._pipe], [], max(0.0, deadline - monotonic()))
            if not ready:
                raise TimeoutError("the process does not read")
            left = left[os.write(self._pipe.fileno(), left[: select.PIPE_BUF]) :]
