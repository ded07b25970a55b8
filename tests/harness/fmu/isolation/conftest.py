from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[4]


@pytest.fixture(autouse=True)
def importable_tasks(monkeypatch: pytest.MonkeyPatch) -> None:
    """The process of an FMU finds the tasks of the tests."""
    monkeypatch.setenv("PYTHONPATH", str(REPOSITORY))
