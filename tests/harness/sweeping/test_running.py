"""What a sweep makes of points that fail, hang or crash the FMU."""

from pathlib import Path

import pytest

from slider_resonator.fmu.isolation.tasks import LocalProcesses
from slider_resonator.sweeping.measures import Row, Run, Task
from slider_resonator.sweeping.sweeping import run_points
from tests.harness.faulty_fmus import compiled

pytestmark = pytest.mark.isolated

POINTS = [(number, (0.1 * (1 + number),)) for number in range(3)]


def rows_of(fmu: Path, time_limit: float, measure: str = "velocity.rms") -> list[Row]:
    task = Task(
        ("friction_coefficient",), (), (measure,), 20, Run(drive_periods=1, steps_per_period=1)
    )
    kept: list[Row] = []
    with LocalProcesses(fmu, time_limit) as processes:
        run_points(processes, task, POINTS, kept.extend)
    assert sorted(row[0] for row in kept) == [0, 1, 2], "each point is computed once"
    return sorted(kept)


def test_point_over_the_time_limit_is_a_row(native_fmu: Path, tmp_path: Path) -> None:
    """Endless in the second run of a process."""
    slow = "static int set; if (set) { LOOP } set = 1;"
    fmu = compiled(native_fmu, tmp_path / "slow.fmu", f"IN_STEP={slow}", "VALUE=1.0")
    rows = rows_of(fmu, 1.0)
    assert [row[2] is None for row in rows] == [True, False, True], rows
    assert "no answer within the time limit of 1 s in fmi2DoStep" in str(rows[1][2])


def test_a_process_that_dies_once_costs_no_point(native_fmu: Path, tmp_path: Path) -> None:
    """The FMU crashes unless a file is there, which it makes before."""
    mark = tmp_path / "mark"
    once = f'if (!fopen("{mark}", "r")) {{ fopen("{mark}", "w"); CRASH }}'
    fmu = compiled(native_fmu, tmp_path / "once.fmu", f"IN_STEP={once}", "VALUE=1.0")
    assert all(row[2] is None for row in rows_of(fmu, 60.0))


@pytest.mark.slow
def test_predictions_that_hang_are_left_to_single_points(native_fmu: Path, tmp_path: Path) -> None:
    fmu = compiled(native_fmu, tmp_path / "hangs.fmu", "IN_STEP=LOOP", "VALUE=2.0")
    for _, cells, error in rows_of(fmu, 1.0, "steady_velocity"):
        assert cells == [None, None]
        assert "no answer within the time limit of 1 s" in str(error)
