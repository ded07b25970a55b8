"""The process that an FMU is measured in: whatever the FMU does to it, the verdict survives.

`python -m slider_resonator.fmu.isolation.child FMU SECONDS` reads pickled requests from its
standard input (a scene file, what a sweep varies, what to measure) and writes a pickled answer for
each to its standard output. What the FMU prints goes to standard error. A call that takes longer
than SECONDS ends the process.
"""

from __future__ import annotations

import faulthandler
import os
import pickle
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.drive import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.scenes.scene import read_scene


@dataclass(frozen=True)
class Request:
    """A scene file, values that replace those in it, and the function that measures in it."""

    scene: Path
    at: Mapping[str, float]
    measure: Callable[[FmuSide], Any]


@dataclass(frozen=True)
class Answer:
    """What was measured, or what went wrong.

    The first answer, before any request, has neither: the FMU has been instantiated.
    """

    result: Any = None
    error: str = ""


def main() -> None:
    """Instantiate the FMU and answer requests until there are no more."""
    path, limit = sys.argv[1], float(sys.argv[2])
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    faulthandler.enable()
    faulthandler.dump_traceback_later(limit, exit=True)
    try:
        with open_fmu(path) as fmu, instantiate(fmu) as instance:
            faulthandler.cancel_dump_traceback_later()
            _write(Answer(), answers)
            for request in _requests():
                with _limited(limit):
                    answer = _answer(instance, request)
                _write(answer, answers)
            faulthandler.dump_traceback_later(limit, exit=True)
    except HarnessError as error:
        _write(Answer(error=str(error)), answers)


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    """End the process, with a traceback, when the block takes longer: also inside native code."""
    faulthandler.dump_traceback_later(seconds, exit=True)
    try:
        yield
    finally:
        faulthandler.cancel_dump_traceback_later()


def _requests() -> Iterator[Request]:
    while True:
        try:
            yield pickle.load(sys.stdin.buffer)
        except EOFError:
            return


def _answer(instance: Instance, request: Request) -> Answer:
    try:
        scene = read_scene(request.scene, request.at)
        return Answer(request.measure(FmuSide(instance, scene)))
    except HarnessError as error:
        return Answer(error=str(error))


def _write(answer: Answer, file: BinaryIO) -> None:
    pickle.dump(answer, file)
    file.flush()


if __name__ == "__main__":
    # Under its real name, so that what is pickled here is known where it is read.
    from slider_resonator.fmu.isolation.child import main as serve

    serve()
