"""The solvers of scipy, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from scipy.integrate import DOP853, LSODA, Radau

from slider_resonator.arrays import Array

Dense = Callable[[float | Array], Array]
"""States, shape (k,) or (k, n), at a time or at times (n,) within a step."""

Method = Callable[..., Any]
"""Makes a solver; scipy's stubs refuse an array of absolute tolerances."""

METHODS: Mapping[str, Method] = {"DOP853": DOP853, "LSODA": LSODA, "Radau": Radau}


def scipy_method(name: str) -> Method:
    """Return a solver; ValueError, with the known names, for an unknown one."""
    if name not in METHODS:
        raise ValueError(f"method = {name!r}: must be one of {', '.join(METHODS)}")
    return METHODS[name]


def take_step(solver: Any, time: float, advice: str) -> None:
    """Take a step of a solver that started at a time (s).

    Raises RuntimeError, with the time and the advice, if it fails.
    """
    message = solver.step()
    if solver.status == "failed":
        raise RuntimeError(
            f"{type(solver).__name__} failed at t = {time + float(solver.t)!r} s: {message}; "
            f"{advice}"
        )
