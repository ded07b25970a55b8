"""Whole sweeps: the table does not depend on workers, order or interruptions."""

from __future__ import annotations

import os
import random
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from pyarrow import parquet

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.steady.steady_velocity import find_steady
from slider_resonator.sweeping.grid import read_grid
from slider_resonator.sweeping.kept_points import journal_path, open_journal
from slider_resonator.sweeping.sweeping import run_sweep

DEADLINE = 120.0
"""Seconds after which a sweep of seconds counts as hanging."""


def test_one_and_two_workers_write_the_same_table(
    grid: Path, native_fmu: Path, tmp_path: Path
) -> None:
    sweep = read_grid(grid)
    one = run_sweep(sweep, native_fmu, tmp_path / "one.parquet", workers=1)
    two = run_sweep(sweep, native_fmu, tmp_path / "two.parquet", workers=2)
    assert (tmp_path / "one.parquet").read_bytes() == (tmp_path / "two.parquet").read_bytes()
    assert one == two
    assert (one.points, one.found, one.failed) == (30, 0, 15)
    assert "friction_coefficient = 0.0 refused" in str(one.first_error)
    rows = parquet.read_table(tmp_path / "one.parquet").to_pylist()
    for row in rows:
        refused = row["friction_coefficient"] == 0.0
        assert (row["error"] is not None) == (row["velocity.rms"] is None) == refused
    assert not journal_path(tmp_path / "one.parquet").exists()


def test_finished_points_are_found_and_not_computed_again(
    grid: Path, native_fmu: Path, tmp_path: Path
) -> None:
    class Interrupted(Exception):
        pass

    def interrupt(label: str, share: float) -> None:
        if share > 0.3:
            raise Interrupted

    sweep, out = read_grid(grid), tmp_path / "a.csv"
    with pytest.raises(Interrupted):
        run_sweep(sweep, native_fmu, out, workers=2, progress=interrupt)
    assert not out.exists()
    lines = journal_path(out).read_bytes().count(b"\n") - 1
    assert lines >= 0.3 * len(sweep.points)
    assert run_sweep(sweep, native_fmu, out, workers=2).found == lines
    run_sweep(sweep, native_fmu, tmp_path / "b.csv", workers=1)
    assert out.read_bytes() == (tmp_path / "b.csv").read_bytes()


def test_points_of_another_grid_are_refused_unless_discarded(
    grid: Path, native_fmu: Path, tmp_path: Path
) -> None:
    out = tmp_path / "a.csv"
    with open_journal(out, "other"):
        pass
    sweep = read_grid(grid)
    with pytest.raises(HarnessError, match="another sweep"):
        run_sweep(sweep, native_fmu, out, workers=1)
    assert run_sweep(sweep, native_fmu, out, workers=1, restart=True).found == 0


def test_an_invalid_fmu_is_refused_before_the_journal_is_written(
    grid: Path, tmp_path: Path
) -> None:
    with pytest.raises(HarnessError, match=r"none\.fmu: no such file"):
        run_sweep(read_grid(grid), tmp_path / "none.fmu", tmp_path / "a.csv", workers=1)
    assert not journal_path(tmp_path / "a.csv").exists()


def _start(grid: Path, fmu: Path, out: Path) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "harness", "sweep", str(grid), "--out", str(out)]
    return subprocess.Popen([*command, "--fmu", str(fmu), "--workers", "2"])


def _wait_for_points(process: subprocess.Popen[bytes], out: Path, points: int) -> None:
    until = time.monotonic() + DEADLINE
    while process.poll() is None and time.monotonic() < until:
        path = journal_path(out)
        if path.exists() and path.read_bytes().count(b"\n") > points:
            return
        time.sleep(0.01)


def _children(process: subprocess.Popen[bytes]) -> list[int]:
    """Return the processes of the FMU, which the threads of the sweep started."""
    return [
        int(child)
        for thread in Path(f"/proc/{process.pid}/task").iterdir()
        for child in (thread / "children").read_text().split()
    ]


@pytest.fixture(scope="module")
def undisturbed(
    long_grid: Path, native_fmu: Path, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """The table of the long grid, from a sweep that nothing has happened to."""
    table = tmp_path_factory.mktemp("undisturbed") / "undisturbed.parquet"
    assert _start(long_grid, native_fmu, table).wait(DEADLINE) == 0
    return table


def _kill(process: subprocess.Popen[bytes]) -> None:
    """Kill a sweep and wait for its workers to end."""
    workers = _children(process)
    os.kill(process.pid, signal.SIGKILL)
    process.wait(DEADLINE)
    until = time.monotonic() + 20.0
    while any(Path(f"/proc/{worker}").exists() for worker in workers):
        assert time.monotonic() < until, "workers end with the process that they worked for"
        time.sleep(0.05)


@pytest.mark.parametrize(
    "kills", [pytest.param(3, marks=pytest.mark.slow), pytest.param(12, marks=pytest.mark.nightly)]
)
def test_a_sweep_killed_at_random_is_resumed_to_the_same_file(
    long_grid: Path, undisturbed: Path, native_fmu: Path, tmp_path: Path, kills: int
) -> None:
    out = tmp_path / "killed.parquet"
    kept = 0
    for seed in range(kills):
        process = _start(long_grid, native_fmu, out)
        chosen = kept + random.Random(seed).randrange(150)
        _wait_for_points(process, out, chosen)
        assert process.poll() is None, f"seed {seed}: the sweep has come to its end before the kill"
        _kill(process)
        before, kept = kept, journal_path(out).read_bytes().count(b"\n") - 1
        print(f"seed {seed}: killed after {kept} points")
        assert kept >= before, "what was finished stays"
    *lines, _cut_off = journal_path(out).read_bytes().split(b"\n")
    points = [line.partition(b",")[0] for line in lines[1:]]
    assert len(set(points)) == len(points), "no point is computed twice"
    assert _start(long_grid, native_fmu, out).wait(DEADLINE) == 0
    assert out.read_bytes() == undisturbed.read_bytes()
    assert not journal_path(out).exists()


@pytest.mark.slow
def test_a_killed_worker_is_replaced(
    long_grid: Path, undisturbed: Path, native_fmu: Path, tmp_path: Path
) -> None:
    out = tmp_path / "killed.parquet"
    process = _start(long_grid, native_fmu, out)
    _wait_for_points(process, out, 300)
    os.kill(_children(process)[0], signal.SIGKILL)
    assert process.wait(DEADLINE) == 0
    assert out.read_bytes() == undisturbed.read_bytes()


@pytest.mark.slow
def test_velocities_are_those_of_the_command_steady(
    wide_grid: Path, native_fmu: Path, tmp_path: Path
) -> None:
    result = run_sweep(read_grid(wide_grid), native_fmu, tmp_path / "a.csv", workers=2)
    with open_fmu(native_fmu) as fmu, instantiate(fmu) as instance:
        for index in range(0, 1230, 97):
            names = ("frequency_ratio", "phase")
            values = {name: result.columns[name][index] for name in names}
            alone = find_steady(instance, values)
            assert result.columns["steady_velocity"][index] == alone.steady_velocity, values


def test_the_table_of_another_grid_is_replaced_only_when_asked(
    grid: Path, native_fmu: Path, tmp_path: Path
) -> None:
    other = tmp_path / "other.toml"
    other.write_text("[grid]\nphase = [0.1, 0.2]\n", encoding="utf-8")
    for name in ("a.csv", "a.parquet"):
        out = tmp_path / name
        run_sweep(read_grid(other), native_fmu, out, workers=1)
        table = out.read_bytes()
        run_sweep(read_grid(other), native_fmu, out, workers=1)
        assert out.read_bytes() == table, "its own table is written again"
        with pytest.raises(HarnessError, match=f"{name}: is not a table of this grid's points"):
            run_sweep(read_grid(grid), native_fmu, out, workers=1)
        assert out.read_bytes() == table
        assert not journal_path(out).exists()
    other.write_text("[grid]\nphase = [0.1, 0.3]\n", encoding="utf-8")
    with pytest.raises(HarnessError, match="--overwrite"):
        run_sweep(read_grid(other), native_fmu, out, workers=1)
    assert run_sweep(read_grid(other), native_fmu, out, workers=1, overwrite=True).points == 2


def test_points_without_an_answer_are_counted(native_fmu: Path, tmp_path: Path) -> None:
    """No load below the friction of contact stops a slider that the vibration does not drive."""
    away = tmp_path / "away.toml"
    away.write_text("[grid]\nload = [0.0, 1.0]\n", encoding="utf-8")
    result = run_sweep(read_grid(away), native_fmu, tmp_path / "a.csv", workers=1)
    assert (result.points, result.failed, result.unanswered) == (2, 0, 1)


def test_a_damaged_line_costs_its_point_only(grid: Path, native_fmu: Path, tmp_path: Path) -> None:
    sweep, out = read_grid(grid), tmp_path / "a.csv"
    run_sweep(sweep, native_fmu, out, workers=1)
    table = out.read_bytes()

    def interrupt(label: str, share: float) -> None:
        if share >= 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as caught:
        run_sweep(sweep, native_fmu, out, workers=1, progress=interrupt)
    (note,) = caught.value.__notes__
    assert f"of {len(sweep.points)} points are kept in {journal_path(out)}" in note
    content = journal_path(out).read_bytes().splitlines(keepends=True)
    content[2] = re.sub(rb"\d(?=\D*$)", lambda digit: b"%d" % (9 - int(digit[0])), content[2])
    journal_path(out).write_bytes(b"".join(content))
    result = run_sweep(sweep, native_fmu, out, workers=1)
    assert result.damaged == [3]
    assert result.found == len(content) - 2
    assert out.read_bytes() == table
