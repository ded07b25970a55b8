"""FMUs in this process, where an isolated FMU would have one of its own: a start takes a second."""

import pickle
import threading
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.isolation.process import TIME_LIMIT, FmuDied, IsolatedFmu, Task
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.output.progress import Progress


@dataclass(frozen=True)
class InProcess(IsolatedFmu):
    """Runs tasks as an isolated FMU does: what is sent there and back must be picklable."""

    instance: Instance | None

    def run(self, task: Task, progress: Progress | None = None) -> Any:
        """Return the result of a task."""
        options = {} if progress is None else {"progress": progress}
        sent: Task = pickle.loads(pickle.dumps(task))
        return pickle.loads(pickle.dumps(sent(self.instance, **options)))


def run_in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let `IsolatedFmu` start no process: an FMU must not crash then, and has no time limit."""
    for name, method in {"__init__": _open, "run": _run, "close": IsolatedFmu.kill}.items():
        monkeypatch.setattr(IsolatedFmu, name, method)


def _open(
    self: Any, fmu: Path | None, time_limit: float = TIME_LIMIT, stop: threading.Event | None = None
) -> None:
    self.time_limit = time_limit
    self._killed = False
    self._stop = stop or threading.Event()
    self._resources = ExitStack()
    self._here = InProcess(None)
    if fmu is not None:
        with ExitStack() as resources:
            opened = resources.enter_context(open_fmu(fmu))
            self._here = InProcess(resources.enter_context(instantiate(opened)))
            self._resources = resources.pop_all()
        self.runs_without_python = opened.runs_without_python
        self.guid = str(opened.description.guid)
        self.interpolates = opened.interpolates


def _run(self: Any, task: Task, progress: Progress | None = None) -> Any:
    if self._stop.is_set():
        raise FmuDied("the process of the FMU has been stopped")
    return self._here.run(task, progress)
