"""CVODE, from scikit-sundae."""

from __future__ import annotations

import importlib
from typing import Any

MAX_STEPS = 5_000_000
"""Steps after which CVODE gives up."""


def cvode() -> Any:
    """Return the solver's class; ModuleNotFoundError without scikit-sundae."""
    try:
        return importlib.import_module("sksundae.cvode").CVODE
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "the CVODE peer needs scikit-sundae: pip install 'slider-resonator[peers]'"
        ) from error
