"""Which statements of the component a scene executes, so that no mutant is run in vain.

A copy of the FMU notes each statement as it comes by. It is run in a process of its own: two FMUs
in one process share their modules.
"""

from __future__ import annotations

import ast
import multiprocessing
import sys
import tempfile
import time
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path, PurePosixPath
from types import ModuleType

from harness.compare import measure
from harness.drive import instantiate
from harness.fmu import open_fmu
from harness.fmu_side import FmuSide
from harness.mutants.archive import PythonFmu
from harness.mutants.enumerate_source import Function, blocks
from harness.scene import read_scene

Place = tuple[str, int]
"""Module and line in which a statement begins."""
Request = tuple[Path, Mapping[str, float]]
"""Scene file, and values that replace some in it."""

_NOTED = "_noted_lines"
_SHELL = "slave.py"
"""The module whose caches are no results: they say what is to be done when the process ends."""


@dataclass(frozen=True)
class Reach:
    """The statements that a scene executes, and the CPU seconds that it takes to do so."""

    places: frozenset[Place]
    cost: float


def reaches(fmu: PythonFmu, requests: Sequence[Request], processes: int) -> list[Reach]:
    """Return what each scene, or point of a sweep, executes.

    Raises FmuError when the FMU cannot run one of them.
    """
    with tempfile.TemporaryDirectory(prefix="slider-resonator-") as folder:
        noting = Path(folder) / "noting.fmu"
        noted = {fmu.path_of(name): noting_source(text) for name, text in fmu.modules.items()}
        fmu.write(noting, noted)
        package = PurePosixPath(fmu.package).name
        shares = [requests[i::processes] for i in range(processes)]
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(processes, context) as pool:
            parts = list(pool.map(partial(_observe, noting, package), shares))
    found: list[Reach] = [Reach(frozenset(), 0.0)] * len(requests)
    for index, part in enumerate(parts):
        found[index::processes] = part
    return found


def noting_source(text: str) -> str:
    """Return a module's source with a note of its line before each statement of a function."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, Function):
            _note(node.body)
    last = max(
        (i for i, s in enumerate(tree.body) if isinstance(s, ast.ImportFrom) and _future(s)),
        default=-1,
    )
    tree.body[last + 1 : last + 1] = ast.parse(f"{_NOTED} = set()").body
    return ast.unparse(ast.fix_missing_locations(tree))


def _future(statement: ast.ImportFrom) -> bool:
    return statement.module == "__future__"


def _note(body: list[ast.stmt]) -> None:
    for index in range(len(body) - 1, -1, -1):
        statement = body[index]
        if isinstance(statement, Function):
            continue  # its own body is noted on its own
        for block in blocks(statement):
            _note(block)
        body[index:index] = ast.parse(f"{_NOTED}.add({statement.lineno})").body


def _observe(noting: Path, package: str, requests: Iterable[Request]) -> list[Reach]:
    found = []
    with open_fmu(noting) as fmu, instantiate(fmu) as instance:
        modules = {
            f"{name.rpartition('.')[2]}.py": module
            for name, module in sys.modules.items()
            if name.startswith(f"{package}.")
        }
        loaded = _noted(modules)
        for file, at in requests:
            for name, module in modules.items():
                vars(module)[_NOTED].clear()
                if name != _SHELL:
                    _forget_results(vars(module))
            began = time.process_time()
            scene = read_scene(file, at)
            side = FmuSide(instance, scene)
            for expect in scene.expect:
                measure(expect, side)
            cost = time.process_time() - began
            found.append(Reach(loaded | _noted(modules), cost))
    return found


def _noted(modules: Mapping[str, ModuleType]) -> frozenset[Place]:
    return frozenset((name, line) for name, m in modules.items() for line in vars(m)[_NOTED])


def _forget_results(namespace: Mapping[str, object]) -> None:
    """Empty the caches of pure functions: what they skip would look as if it were not reached."""
    for thing in namespace.values():
        clear = getattr(thing, "cache_clear", None)
        if clear is not None:
            clear()
