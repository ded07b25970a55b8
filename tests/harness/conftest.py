from collections.abc import Iterator
from pathlib import Path

import pytest

from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import Fmu, open_fmu


@pytest.fixture(scope="session")
def fmu(request: pytest.FixtureRequest) -> Iterator[Fmu]:
    """The native FMU, opened; in tests marked with `fmus.both_fmus` the Python one as well."""
    path: Path = request.getfixturevalue(f"{getattr(request, 'param', 'native')}_fmu")
    with open_fmu(path) as opened:
        yield opened


@pytest.fixture(scope="session")
def instance(fmu: Fmu) -> Iterator[Instance]:
    """One instance for all tests: every start resets it."""
    with instantiate(fmu) as made:
        yield made
