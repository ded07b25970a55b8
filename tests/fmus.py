"""Which tests run with which FMU."""

from __future__ import annotations

import pytest


def _fmus(*names: str) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("fmu", names, indirect=True, scope="session")


native_fmu_only = _fmus("native")
both_fmus = _fmus("native", "python")
"""Runs a test with the native and with the Python FMU."""

controller_fmu_only = _fmus("controller")
every_fmu = _fmus("native", "python", "controller")
