"""Which tests run with which FMU."""

import pytest


def _fmus(*names: str) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("fmu", names, indirect=True, scope="session")


native_fmu_only = _fmus("native")
both_fmus = _fmus("native", "python")
"""Runs a test with the native and with the Python FMU."""

every_slider = _fmus("native", "python", "native_3")
"""The same, and with the native FMU of FMI 3.0."""

controller_fmu_only = _fmus("controller")
every_fmu = _fmus("native", "python", "native_3", "controller")
