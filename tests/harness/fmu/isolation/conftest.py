import pytest

from tests.processes import ROOT


@pytest.fixture(autouse=True)
def importable_tasks(monkeypatch: pytest.MonkeyPatch) -> None:
    """The process of an FMU finds the tasks of the tests."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
