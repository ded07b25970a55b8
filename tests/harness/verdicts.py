"""Verdicts of each kind for the reports, made by hand."""

from dataclasses import replace

import numpy as np

from slider_resonator.checks.compare import Check, Curves
from slider_resonator.checks.validate import NotApplied, RunFailure, Validation

PASSED = Check(
    *("phase_sweep", "steady_velocity", "m/s", 0.126667, "located_events", 0.126667),
    *(1e-10, 1e-7, True, "both must agree", "", {"phase": 0.0}),
)
SLOWER = replace(PASSED, fmu=0.12, deviation=0.006667, passed=False, at={"phase": 0.4})
NONE = replace(SLOWER, fmu=None, deviation=None, allowed=None, note="no steady motion <here>")
WORD = Check(
    *("stuck", "steady_status", "", "steady", "value", "stuck"),
    *(None, None, False, "every period is spent sticking"),
)
BOUND = Check(
    *("table_1", "steady_periods", "1", 120, "at most", 100.0, 20.0, 0.0, False, "no long run")
)
SIGNAL = Check(
    *("table_1", "position", "m", 2e-4, "located_events", 1e-4, 3e-4, 1e-8, False, "exact"),
    first_time=0.0125,
    worst_time=0.05,
    fmu_then=1.3e-4,
    reference_then=1e-4,
)
TIMES = np.linspace(0.0, 0.1, 200)
CURVES = Curves(SIGNAL, TIMES, 1e-4 * np.sin(300.0 * TIMES) + 3e-8, 1e-4 * np.sin(300.0 * TIMES))
CRASH = RunFailure("lift_off", "the FMU crashed in fmi2DoStep: \x01 | <b>", {"phase": 0.4})

GOOD = Validation("good.fmu", (PASSED,), 1.5)
BAD = Validation("bad.fmu", (PASSED, SLOWER, SIGNAL), 2.5, (), (CURVES,))
LACKING = Validation(
    *("old.fmu", (PASSED,), 1.0),
    lacks=("averaging_order",),
    not_applied=(NotApplied("order_2", "position", "needs | <averaging_order>", {"load": 0.1}),),
)
BROKEN = Validation("broken.fmu", (PASSED, SLOWER), 3.0, (CRASH,))
