"""Which tests run with which FMU."""

from __future__ import annotations

import pytest

both_fmus = pytest.mark.parametrize("fmu", ["native", "python"], indirect=True, scope="session")
"""Runs a test with the native and with the Python FMU."""
