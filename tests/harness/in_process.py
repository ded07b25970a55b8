"""Tasks on an instance in this process, where an isolated FMU would run them in its own."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from slider_resonator.fmu.instance import Instance


@dataclass(frozen=True)
class InProcess:
    """Runs tasks as an isolated FMU does: what is sent there and back must be picklable."""

    instance: Instance

    def run(self, task: Callable[[Instance], Any]) -> Any:
        """Return the result of a task."""
        sent: Callable[[Instance], Any] = pickle.loads(pickle.dumps(task))
        return pickle.loads(pickle.dumps(sent(self.instance)))
