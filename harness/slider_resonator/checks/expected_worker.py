"""A process that computes the expected values of scenes.

`python -m slider_resonator.checks.expected_worker` reads scenes from its standard input and writes
a message for each to its standard output, both pickled, until the input ends.
"""

from __future__ import annotations

import os
import pickle
import sys
import traceback
from typing import BinaryIO

from slider_resonator.checks.expected_values import values_in
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.messages import Failure, Result
from slider_resonator.scenes.scene import Scene


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
