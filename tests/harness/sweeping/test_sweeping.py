"""Whole sweeps: the table does not depend on workers, order or interruptions."""

import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import closing, suppress
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from distributed import LocalCluster, Worker
from pyarrow import parquet

from slider_resonator.errors import HarnessError
from slider_resonator.output.journal import Journal
from slider_resonator.sweeping import cluster, sweeping
from slider_resonator.sweeping.grid import grid_from
from slider_resonator.sweeping.sweeping import run_sweep

DEADLINE = 120.0
"""Seconds after which a sweep of seconds counts as hanging."""


GRID = grid_from(
    {
        "measures": ["steady_velocity", "blocking_force", "velocity.rms"],
        "max_denominator": 4,
        "fixed": {"damping_ratio": 0.1, "friction_law": 1},
        "grid": {
            "frequency_ratio": {"from": 0.5, "to": 2.5, "count": 3},
            "phase": [0.0, 1.3],
            "friction_coefficient": [0.1, 0.0],
        },
        "run": {"drive_periods": 5},
    },
    "a grid",
)
"""Half of the points are refused by the FMU: LuGre friction needs a coefficient above 0."""
PHASE = {"phase": [0.0, 0.1, 0.2, 0.3]}
FEW = grid_from({"grid": PHASE}, "few points")
OTHER_DEVICE = grid_from({"grid": PHASE, "fixed": {"friction_coefficient": 0.2}}, "other device")
RATIOS = {"from": 0.5, "to": 5.5, "count": 41}
PHASES = {"from": 0.0, "to": 3.1, "count": 30}
WIDE = grid_from({"grid": {"frequency_ratio": RATIOS, "phase": PHASES}}, "a wide grid")
"""Enough points to be killed in between."""
LONG = "[grid]\nfrequency_ratio = [1.0, 3.0]\nphase = { from = 0.0, to = 3.1, count = 2000 }\n"
"""Enough cheap points to be killed a dozen times in between."""


def journal_path(table: Path) -> Path:
    return table.with_name(f"{table.name}.journal")


def kept_points(out: Path) -> int:
    """Return how many points the journal of a table holds, also while a sweep writes it."""
    path = journal_path(out)
    if not path.exists():
        return 0
    with closing(sqlite3.connect(f"{path.as_uri()}?immutable=1", uri=True)) as file:
        try:
            return sum(
                len(json.loads(rows)) for (rows,) in file.execute("SELECT entry FROM entries")
            )
        except sqlite3.DatabaseError:  # it is being written
            return 0


def test_one_and_two_workers_write_the_same_table(native_fmu: Path, tmp_path: Path) -> None:
    one = run_sweep(GRID, native_fmu, tmp_path / "one.parquet", workers=1)
    two = run_sweep(GRID, native_fmu, tmp_path / "two.parquet", workers=2)
    assert (tmp_path / "one.parquet").read_bytes() == (tmp_path / "two.parquet").read_bytes()
    assert one == two
    assert (one.points, one.found, one.failed) == (12, 0, 6)
    assert "friction_coefficient = 0.0 refused" in str(one.first_error)
    rows = parquet.read_table(tmp_path / "one.parquet").to_pylist()
    for row in rows:
        refused = row["friction_coefficient"] == 0.0
        assert (row["error"] is not None) == (row["velocity.rms"] is None) == refused
    assert not journal_path(tmp_path / "one.parquet").exists()


def interrupt(label: str, share: float) -> None:
    if share >= 0.5:
        raise KeyboardInterrupt


def test_only_missing_points_are_computed(native_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "a.csv"
    with pytest.raises(KeyboardInterrupt) as caught:
        run_sweep(GRID, native_fmu, out, workers=1, progress=interrupt)
    (note,) = caught.value.__notes__
    assert f"of {len(GRID.points)} points are kept in {journal_path(out)}" in note
    assert not out.exists()
    kept = kept_points(out)
    assert kept >= 0.5 * len(GRID.points)
    result = run_sweep(GRID, native_fmu, out, workers=1)
    assert result.found == kept
    run_sweep(GRID, native_fmu, tmp_path / "b.csv", workers=1)
    assert out.read_bytes() == (tmp_path / "b.csv").read_bytes()


def test_points_of_another_grid_are_refused(native_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "a.csv"
    with Journal(journal_path(out), "sweep", "other", ""):
        pass
    with pytest.raises(HarnessError, match=r"another sweep.*restart=True"):
        run_sweep(FEW, native_fmu, out, workers=1)
    assert run_sweep(FEW, native_fmu, out, workers=1, restart=True).found == 0


def _start(grid: Path, fmu: Path, out: Path) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "harness", "sweep", str(grid), "--out", str(out)]
    return subprocess.Popen([*command, "--fmu", str(fmu), "--workers", "2"])


def _kill(process: subprocess.Popen[bytes]) -> None:
    """Kill a sweep and wait for the processes of its FMU, which its threads started, to end."""
    workers: list[str] = []
    for thread in Path(f"/proc/{process.pid}/task").iterdir():
        with suppress(FileNotFoundError):  # those that send a task are short-lived
            workers += (thread / "children").read_text().split()
    process.kill()
    process.wait(DEADLINE)
    until = time.monotonic() + 20.0
    while any(Path(f"/proc/{worker}").exists() for worker in workers):
        assert time.monotonic() < until, "workers end with the process that they worked for"
        time.sleep(0.05)


@pytest.mark.parametrize(
    "kills", [pytest.param(3, marks=pytest.mark.slow), pytest.param(6, marks=pytest.mark.nightly)]
)
def test_killed_sweep_resumes_to_the_file(native_fmu: Path, tmp_path: Path, kills: int) -> None:
    long_grid = tmp_path / "long.toml"
    long_grid.write_text(LONG, encoding="utf-8")
    undisturbed, out = tmp_path / "undisturbed.parquet", tmp_path / "killed.parquet"
    assert _start(long_grid, native_fmu, undisturbed).wait(DEADLINE) == 0
    kept = 0
    for seed in range(kills):
        process = _start(long_grid, native_fmu, out)
        chosen = kept + random.Random(seed).randrange(150)
        until = time.monotonic() + DEADLINE
        while kept_points(out) <= chosen and time.monotonic() < until:
            assert process.poll() is None, f"seed {seed}: the sweep has ended before the kill"
            time.sleep(0.01)
        _kill(process)
        before, kept = kept, kept_points(out)
        print(f"seed {seed}: killed after {kept} points")
        assert kept >= before, "what was finished stays"
    assert _start(long_grid, native_fmu, out).wait(DEADLINE) == 0
    assert out.read_bytes() == undisturbed.read_bytes()
    assert not journal_path(out).exists()


def test_a_table_is_replaced_only_where_that_is_asked(native_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "a.csv"
    run_sweep(FEW, native_fmu, out, workers=1)
    table = out.read_text()
    with pytest.raises(HarnessError, match=r"a\.csv: exists; must be a new file, or allow it"):
        run_sweep(OTHER_DEVICE, native_fmu, out, workers=1)
    assert out.read_text() == table
    with pytest.raises(KeyboardInterrupt):
        run_sweep(OTHER_DEVICE, native_fmu, out, workers=1, overwrite=True, progress=interrupt)
    assert out.read_text() == table, "until the sweep is finished"
    run_sweep(OTHER_DEVICE, native_fmu, out, workers=1, overwrite=True)
    assert out.read_text() != table


@pytest.mark.slow
def test_cluster_writes_the_same_table(native_fmu: Path, tmp_path: Path) -> None:
    start: Callable[..., LocalCluster] = LocalCluster
    victims: list[int] = []

    def kill_once(label: str, share: float) -> None:
        if share > 0.3 and victims:
            os.kill(victims.pop(), signal.SIGKILL)

    with start(n_workers=2, threads_per_worker=1, dashboard_address=None) as workers:
        address = workers.scheduler_address
        for sweep, killed in ((GRID, []), (WIDE, [workers.workers[0].pid])):
            victims += killed
            here, there = (tmp_path / f"{place}{len(killed)}.parquet" for place in ("a", "b"))
            run_sweep(sweep, native_fmu, here, workers=2)
            run_sweep(sweep, native_fmu, there, workers=1, dask=address, progress=kill_once)
            assert there.read_bytes() == here.read_bytes()
            assert not victims, "the worker was killed in mid-sweep"


def test_no_scheduler(native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "CONNECT_SECONDS", 0.5)
    for address in ("tcp://127.0.0.1:9", "no address"):
        with pytest.raises(HarnessError, match=f"--dask {address}: no scheduler answers"):
            run_sweep(FEW, native_fmu, tmp_path / "a.csv", workers=1, dask=address)


def test_a_worker_of_another_version_refuses(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plugin = cluster.FmuPlugin("digest", native_fmu.name, native_fmu.read_bytes(), 60.0)
    plugin.version = "0.0"
    worker = SimpleNamespace(address="tcp://192.0.2.7:1", local_directory=str(tmp_path))
    with pytest.raises(HarnessError, match=r"worker tcp://192\.0\.2\.7:1 has .*must be 0\.0"):
        plugin.setup(cast(Worker, worker))
    assert list(tmp_path.iterdir()) == []
    worker.plugins = {plugin.name: plugin}
    monkeypatch.setattr(cluster, "get_worker", lambda: worker)
    for name in (plugin.name, "other"):
        assert "has not been given the FMU" in str(cluster.run_task(name, print).error)


def test_no_distributed(native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sweeping, "find_spec", lambda name: None)
    with pytest.raises(HarnessError, match=r"pip install 'slider-resonator\[cluster\]'"):
        run_sweep(FEW, native_fmu, tmp_path / "a.csv", workers=1, dask="tcp://x:1")
    assert not journal_path(tmp_path / "a.csv").exists(), "a sweep that cannot begin leaves nothing"
