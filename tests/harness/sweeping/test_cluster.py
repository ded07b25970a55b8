"""Sweeps on a dask cluster of two local workers."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from distributed import LocalCluster, Worker

from slider_resonator.errors import HarnessError
from slider_resonator.sweeping import cluster, sweeping
from slider_resonator.sweeping.grid import read_grid
from slider_resonator.sweeping.sweeping import run_sweep
from slider_resonator.sweeping.table import journal_path


@pytest.fixture
def two_workers() -> Iterator[LocalCluster]:
    start: Callable[..., LocalCluster] = LocalCluster
    with start(n_workers=2, threads_per_worker=1, dashboard_address=None) as made:
        yield made


@pytest.mark.slow
def test_a_cluster_writes_the_same_table_as_this_machine_also_when_a_worker_is_killed(
    two_workers: LocalCluster, wide_grid: Path, grid: Path, native_fmu: Path, tmp_path: Path
) -> None:
    address = two_workers.scheduler_address
    victims = [two_workers.workers[0].pid]

    def kill_once(label: str, share: float) -> None:
        if share > 0.3 and victims:
            os.kill(victims.pop(), signal.SIGKILL)

    for number, (file, progress) in enumerate([(grid, None), (wide_grid, kill_once)]):
        sweep = read_grid(file)
        here, there = tmp_path / f"here{number}.parquet", tmp_path / f"there{number}.parquet"
        run_sweep(sweep, native_fmu, here, workers=2)
        run_sweep(
            sweep,
            native_fmu,
            there,
            workers=1,
            dask=address,
            progress=progress or (lambda *_: None),
        )
        assert there.read_bytes() == here.read_bytes()
    assert not victims, "the worker was killed in mid-sweep"


def test_a_scheduler_that_is_not_there_is_named(
    grid: Path, native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cluster, "CONNECT_SECONDS", 0.5)
    for address in ("tcp://127.0.0.1:9", "no address"):
        with pytest.raises(HarnessError, match=f"--dask {address}: no scheduler answers"):
            run_sweep(read_grid(grid), native_fmu, tmp_path / "a.csv", workers=1, dask=address)


def test_a_worker_of_another_version_refuses(native_fmu: Path, tmp_path: Path) -> None:
    plugin = cluster.FmuPlugin("digest", native_fmu.name, native_fmu.read_bytes(), 60.0)
    plugin.version = "0.0"
    worker = SimpleNamespace(address="tcp://192.0.2.7:1", local_directory=str(tmp_path))
    with pytest.raises(HarnessError, match=r"worker tcp://192\.0\.2\.7:1 has .*must be 0\.0"):
        plugin.setup(cast(Worker, worker))
    assert list(tmp_path.iterdir()) == []


def test_without_distributed_the_extra_is_named(
    grid: Path, native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sweeping, "find_spec", lambda name: None)
    with pytest.raises(HarnessError, match=r"pip install 'slider-resonator\[cluster\]'"):
        run_sweep(read_grid(grid), native_fmu, tmp_path / "a.csv", workers=1, dask="tcp://x:1")
    assert not journal_path(tmp_path / "a.csv").exists(), "a sweep that cannot begin leaves nothing"
