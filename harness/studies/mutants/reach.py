"""The statements of the component that a scene executes, so that no mutant is run in vain.

A copy of the FMU notes each statement as it comes by.
"""

from __future__ import annotations

import ast
import sys
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measure_points import measure_points
from slider_resonator.checks.measuring import measure_all
from slider_resonator.output.temporary import temporary_folder
from studies.mutants.archive import PythonFmu
from studies.mutants.enumerate_source import Function, blocks
from studies.mutants.trial import ExpectedPoint

Place = tuple[str, int]
"""Module and line in which a statement begins."""

_NOTED = "_noted_lines"
_LOADING = "_lines_noted_at_loading"
_SHELL = "slave.py"
"""The module whose caches hold no results: they are callbacks for the end of the process."""


@dataclass(frozen=True)
class Reach:
    """The statements that a scene executes, and the CPU seconds that it takes to do so."""

    places: frozenset[Place]
    cost: float


def reaches(
    fmu: PythonFmu, points: Sequence[ExpectedPoint], time_limit: float, jobs: int
) -> list[Reach]:
    """Return the reach of each scene or point of a sweep; `jobs` processes share the work.

    Raises FmuError when the FMU cannot run one of them.
    """
    with temporary_folder() as folder:
        noting = folder / "noting.fmu"
        noted = {fmu.path_of(name): noting_source(text) for name, text in fmu.modules.items()}
        fmu.write(noting, noted)
        shares = [points[i::jobs] for i in range(jobs)]
        with ThreadPoolExecutor(jobs) as pool:
            parts = list(pool.map(partial(_observe, noting, time_limit), shares))
    found: list[Reach] = [Reach(frozenset(), 0.0)] * len(points)
    for index, part in enumerate(parts):
        found[index::jobs] = part
    return found


def noting_source(text: str) -> str:
    """Return a module's source with a note of its line before each statement of a function."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, Function):
            _note(node.body)
    last = max((i for i, s in enumerate(tree.body) if _is_future(s)), default=-1)
    tree.body[last + 1 : last + 1] = ast.parse(f"{_NOTED} = set()").body
    tree.body += ast.parse(f"{_LOADING} = frozenset({_NOTED})").body
    return ast.unparse(ast.fix_missing_locations(tree))


def _is_future(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.ImportFrom) and statement.module == "__future__"


def _note(body: list[ast.stmt]) -> None:
    for index in range(len(body) - 1, -1, -1):
        statement = body[index]
        if isinstance(statement, Function):
            continue  # its body is noted separately
        for block in blocks(statement):
            _note(block)
        body[index:index] = ast.parse(f"{_NOTED}.add({statement.lineno})").body


def _observe(noting: Path, time_limit: float, points: Sequence[ExpectedPoint]) -> list[Reach]:
    found = []
    for one in measure_points(noting, points, noted_while_measuring, time_limit):
        if one.error is not None:
            raise one.error
        found.append(one.result)
    return found


def noted_while_measuring(side: FmuSide) -> Reach:
    """Measure what the scene expects, in the process of a noting FMU, and return its reach."""
    forget_noted()
    began = time.process_time()
    measure_all(side)
    return Reach(noted_places(), time.process_time() - began)


def forget_noted() -> None:
    """Forget what noting modules of this process have noted since they were loaded."""
    for name, module in _noting_modules().items():
        module[_NOTED].clear()
        if name != _SHELL:
            _forget_results(module)


def noted_places() -> frozenset[Place]:
    """Return what noting modules of this process have noted, also while they were loaded."""
    modules = _noting_modules().items()
    return frozenset((n, line) for n, m in modules for line in m[_NOTED] | m[_LOADING])


def _noting_modules() -> dict[str, dict[str, Any]]:
    """Return the noting modules of this process by file name, with what they define."""
    return {
        f"{name.rpartition('.')[2]}.py": vars(module)
        for name, module in sys.modules.items()
        if hasattr(module, _LOADING)
    }


def _forget_results(namespace: Mapping[str, object]) -> None:
    """Empty the caches of pure functions, which would hide statements that are reached."""
    for thing in namespace.values():
        clear = getattr(thing, "cache_clear", None)
        if clear is not None:
            clear()
