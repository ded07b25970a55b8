"""The closed loop in another master, which hands values on without fmpy's delay of the inputs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from slider_resonator.studies.closed_loop.duty import Duty
from slider_resonator.studies.closed_loop.judge import judge_agreement, judge_intervals
from slider_resonator.studies.closed_loop.loop import HOSTS, run_loop
from slider_resonator.studies.closed_loop.prediction import predicted_errors

pytestmark = pytest.mark.interop


def test_libcosim_matches_fmpy_in_closed_loop(closed_loop_package: Path) -> None:
    duty = Duty()
    fmpy, libcosim = (run_loop(closed_loop_package, host, duty) for host in HOSTS)
    for record in libcosim:
        failed = [held for held in judge_intervals(record, duty) if not held.passed]
        assert failed == [], "the velocity has to come back after each step of the load"
    predicted = predicted_errors(closed_loop_package, libcosim[0], duty)
    for agreement in judge_agreement(*libcosim, duty, predicted):
        assert agreement.passed, agreement
    for theirs, ours in zip(libcosim, fmpy, strict=True):
        ends = np.searchsorted(
            ours.times, [interval.end - 0.5 * duty.step for interval in duty.intervals]
        )
        assert theirs.velocity[ends] == pytest.approx(ours.velocity[ends], rel=1e-3)
        assert theirs.phase[ends] == pytest.approx(ours.phase[ends], abs=1e-3)
