"""Table 1 by the Windows binary in Wine: the bits of the Linux binary, from the same driver."""

from pathlib import Path

import numpy as np
import pytest

from slider_resonator.device.interface import OUTPUTS
from studies.hosts.hosts import OWN_ENVIRONMENTS, hosts
from studies.hosts.runs import CASES, run_jobs, table_1_jobs

pytestmark = pytest.mark.interop

HOSTS = {host.module: host for host in hosts(Path(__file__).parents[2] / OWN_ENVIRONMENTS)}


def test_windows_gives_the_bits_of_linux(native_fmu_for_wine: Path) -> None:
    jobs = table_1_jobs(native_fmu_for_wine)
    linux, windows = (run_jobs(HOSTS[name], jobs) for name in ("driver_host", "wine_host"))
    for case, ours, theirs in zip(CASES, linux, windows, strict=True):
        assert ours.error is None, f"{case.title}: {ours.error}"
        assert theirs.error is None, f"{case.title}: {theirs.error}"
        differ = (np.asarray(ours.rows) != np.asarray(theirs.rows)).any(axis=0)
        names = [name for name, other in zip(OUTPUTS, differ, strict=True) if other]
        assert names == [], f"{case.title}: other bits in Wine"
