"""The solvers of scipy for references, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from scipy.integrate import DOP853, LSODA, Radau

from slider_resonator.arrays import Array

Dense = Callable[[float | Array], Array]
"""States, shape (k,) or (k, n), at a time or at times (n,) within a step."""


class Solver(Protocol):
    """The used part of a solver; scipy's stubs refuse an array of absolute tolerances."""

    @property
    def status(self) -> str:
        """Whether it is running, finished or failed."""

    @property
    def t(self) -> float:
        """Time at the end of the last step, s."""

    @property
    def y(self) -> Array:
        """State at its end, shape (k,)."""

    @property
    def nfev(self) -> int:
        """Evaluations of the right hand side."""

    def step(self) -> str | None:
        """Take a step; return a message if it fails."""

    def dense_output(self) -> Dense:
        """Return the interpolant of the last step."""


Method = Callable[..., Solver]

METHODS: Mapping[str, Method] = {"DOP853": DOP853, "LSODA": LSODA, "Radau": Radau}


def scipy_method(name: str) -> Method:
    """Return a solver; ValueError, with the known names, for an unknown one."""
    if name not in METHODS:
        raise ValueError(f"method = {name!r}: must be one of {', '.join(METHODS)}")
    return METHODS[name]


def take_step(solver: Solver, time: float, advice: str) -> None:
    """Take a step of a solver that started at a time (s).

    Raises RuntimeError, with the time and the advice, if it fails.
    """
    message = solver.step()
    if solver.status == "failed":
        raise RuntimeError(
            f"{type(solver).__name__} failed at t = {time + float(solver.t)!r} s: {message}; "
            f"{advice}"
        )
