from collections.abc import Iterator

import pytest

from tests.processes import ROOT


@pytest.fixture(autouse=True, scope="module")
def importable_tasks() -> Iterator[None]:
    """The process of an FMU finds the tasks of the tests."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", str(ROOT))
        yield
