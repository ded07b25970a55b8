"""The solvers of scipy that references are run with, by name."""

from __future__ import annotations

from collections.abc import Mapping

from scipy.integrate import DOP853, LSODA, OdeSolver, Radau

METHODS: Mapping[str, type[OdeSolver]] = {"DOP853": DOP853, "LSODA": LSODA, "Radau": Radau}


def scipy_method(name: str) -> type[OdeSolver]:
    """Return a solver; ValueError, with the known names, for an unknown one."""
    if name not in METHODS:
        raise ValueError(f"method = {name!r}: must be one of {', '.join(METHODS)}")
    return METHODS[name]
