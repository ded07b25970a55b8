from pathlib import Path

import pytest

GRID = """
measures = ["steady_velocity", "blocking_force", "velocity.rms"]
max_denominator = 4

[fixed]
damping_ratio = 0.1
friction_law = 1

[grid]
frequency_ratio = { from = 0.5, to = 2.5, count = 3 }
phase = [0.0, 1.3]
friction_coefficient = [0.1, 0.0]

[run]
drive_periods = 5
"""
"""Half of the points are refused by the FMU: LuGre friction needs a coefficient above 0."""


@pytest.fixture
def grid(tmp_path: Path) -> Path:
    path = tmp_path / "grid.toml"
    path.write_text(GRID, encoding="utf-8")
    return path


@pytest.fixture(scope="session")
def wide_grid(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Enough points to be killed in between."""
    path = tmp_path_factory.mktemp("wide") / "wide.toml"
    path.write_text(
        "[grid]\nfrequency_ratio = { from = 0.5, to = 5.5, count = 41 }\n"
        "phase = { from = 0.0, to = 3.1, count = 30 }\n",
        encoding="utf-8",
    )
    return path


@pytest.fixture(scope="session")
def long_grid(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Enough cheap points to be killed a dozen times in between."""
    path = tmp_path_factory.mktemp("long") / "long.toml"
    path.write_text(
        "[grid]\nfrequency_ratio = [1.0, 3.0]\nphase = { from = 0.0, to = 3.1, count = 2000 }\n",
        encoding="utf-8",
    )
    return path
