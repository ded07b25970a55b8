from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from harness.drive import Instance, instantiate
from harness.fmu import Fmu, open_fmu


@pytest.fixture(scope="session")
def fmu(python_fmu: Path) -> Iterator[Fmu]:
    """The Python FMU, opened."""
    with open_fmu(python_fmu) as opened:
        yield opened


@pytest.fixture(scope="session")
def instance(fmu: Fmu) -> Iterator[Instance]:
    """One instance for all tests: every start resets it."""
    with instantiate(fmu) as made:
        yield made
