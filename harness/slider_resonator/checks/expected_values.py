"""Expected values of scenes: on demand in this process, or ahead in processes of their own.

Such a process, `python -m slider_resonator.checks.expected_values`, reads scenes from its standard
input and writes a message for each to its standard output, both pickled, until the input ends.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import traceback
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from queue import SimpleQueue
from typing import Any, BinaryIO

from slider_resonator.checks.expecting import expected_value
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.errors import HarnessError, SceneError
from slider_resonator.fmu.isolation.child_environment import PACKAGE_PATH
from slider_resonator.fmu.isolation.messages import Failure, Result
from slider_resonator.scenes.scene import Scene, ScenePoint

MIN_POINTS = 8
"""Fewest points for a process: loading it takes as long as some references."""


class ExpectedValues:
    """The expected values of scenes at their points, each computed once.

    With `jobs` above 1 and enough `points`, that many processes compute those of `points` from the
    beginning on, in this order. Use it in a `with` block, at the end of which they are ended.
    """

    def __init__(self, points: Sequence[ScenePoint] = (), jobs: int = 1) -> None:
        self._values: dict[ScenePoint, list[Any]] = {}
        self._ahead: dict[ScenePoint, Future[list[Any]]] = {}
        count = min(jobs, len(points) // MIN_POINTS)
        self._workers: list[_Worker] = []
        if count <= 1:
            return
        self._workers = [_Worker() for _ in range(count)]
        self._free: SimpleQueue[_Worker] = SimpleQueue()
        for worker in self._workers:
            self._free.put(worker)
        self._threads = ThreadPoolExecutor(count)
        self._ahead = {point: self._threads.submit(self._compute, point) for point in points}

    def __enter__(self) -> ExpectedValues:
        """Return this."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the processes, also in the middle of a reference."""
        if self._workers:
            self._threads.shutdown(wait=False, cancel_futures=True)
            for worker in self._workers:
                worker.end()
            self._threads.shutdown()

    def _compute(self, point: ScenePoint) -> list[Any]:
        worker = self._free.get()
        try:
            return worker.values(point.scene)
        finally:
            self._free.put(worker)

    def prepare(self, point: ScenePoint) -> None:
        """Compute the values at a point now, unless a process does."""
        if point not in self._ahead and point not in self._values:
            self._values[point] = values_in(point.scene)

    def ready(self, point: ScenePoint) -> bool:
        """Whether `at` does not wait for a process."""
        return point not in self._ahead or self._ahead[point].done()

    def at(self, point: ScenePoint) -> list[Any]:
        """Return a value for each expectation, or the SceneError where there is none.

        Raises HarnessError where a process that computes them has ended.
        """
        if point in self._ahead:
            return self._ahead[point].result()
        self.prepare(point)
        return self._values[point]


def values_in(scene: Scene) -> list[Any]:
    """Return a value for each expectation of a scene, or the SceneError where there is none."""
    references = ReferenceSide(scene)
    values: list[Any] = []
    for expect in scene.expect:
        try:
            values.append(expected_value(expect, references))
        except SceneError as error:
            values.append(error)
    return values


class _Worker:
    """A process that computes expected values; it ends when this one does.

    Not one of `multiprocessing`, which runs the script of a user that calls `validate` once more.
    """

    def __init__(self) -> None:
        search = os.pathsep.join(filter(None, [PACKAGE_PATH, os.environ.get("PYTHONPATH", "")]))
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "slider_resonator.checks.expected_values"],
            env={**os.environ, "PYTHONPATH": search},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            start_new_session=True,  # Ctrl-C is for this process only, which ends its workers
        )

    def values(self, scene: Scene) -> list[Any]:
        requests, answers = self._process.stdin, self._process.stdout
        assert requests is not None
        assert answers is not None
        try:
            pickle.dump(scene, requests)
            requests.flush()
            message = pickle.load(answers)
        except (OSError, EOFError, pickle.UnpicklingError) as error:
            code = self._process.wait()
            raise HarnessError(
                f"scene {scene.name}: the process that computes its references has ended with "
                f"exit code {code}"
            ) from error
        if isinstance(message, Failure):
            raise message.error
        assert isinstance(message, Result)
        values: list[Any] = message.value
        return values

    def end(self) -> None:
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            assert stream is not None
            with suppress(OSError):  # what was not yet sent
                stream.close()


def main() -> None:
    """Answer each scene with a `Result`, or with a `Failure`."""
    os.nice(5)  # an FMU of Python takes longer than its references: it comes first
    scenes, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    while True:
        try:
            scene = pickle.load(scenes)
        except EOFError:
            return
        _answer(scene, answers)


def _answer(scene: Scene, answers: BinaryIO) -> None:
    message: Result | Failure
    try:
        message = Result(values_in(scene))
    except HarnessError as error:
        message = Failure(error)
    except Exception:
        message = Failure(RuntimeError(f"scene {scene.name}:\n{traceback.format_exc()}"))
    pickle.dump(message, answers)
    answers.flush()


if __name__ == "__main__":
    main()
