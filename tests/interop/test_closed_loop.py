"""The closed loop in other masters, which hand values on without fmpy's delay of the inputs."""

from pathlib import Path

import numpy as np
import pytest

from studies.closed_loop.duty import Duty
from studies.closed_loop.judge import judge_agreement, judge_intervals
from studies.closed_loop.loop import HOSTS, run_loop
from studies.closed_loop.prediction import predicted_errors
from studies.hosts.hosts import Host

pytestmark = pytest.mark.interop


FMPY, *OTHERS = HOSTS


@pytest.mark.parametrize("host", OTHERS, ids=lambda host: host.name)
def test_another_master_matches_fmpy_in_closed_loop(closed_loop_package: Path, host: Host) -> None:
    duty = Duty()
    fmpy, other = (run_loop(closed_loop_package, chosen, duty) for chosen in (FMPY, host))
    for record in other:
        failed = [held for held in judge_intervals(record, duty) if not held.passed]
        assert failed == [], "the velocity has to come back after each step of the load"
    predicted = predicted_errors(closed_loop_package, other[0], duty)
    for agreement in judge_agreement(*other, duty, predicted):
        assert agreement.passed, agreement
    for theirs, ours in zip(other, fmpy, strict=True):
        ends = np.searchsorted(
            ours.times, [interval.end - 0.5 * duty.step for interval in duty.intervals]
        )
        assert theirs.velocity[ends] == pytest.approx(ours.velocity[ends], rel=1e-3)
        assert theirs.phase[ends] == pytest.approx(ours.phase[ends], abs=1e-3)
