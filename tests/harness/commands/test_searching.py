from __future__ import annotations

from slider_resonator.steady.blocking_force import Blocking
from slider_resonator.steady.steady_velocity import SteadyMotion


def test_a_result_is_reported_in_sentences() -> None:
    multipliers = (0.9 + 0j, 0.1j)
    outcome = SteadyMotion("steady", "stable", 0.5, True, 1, 40, 3, 1e-14, multipliers, True, 0.25)
    lines = outcome.describe()
    assert lines[0] == "steady velocity  0.25 m/s"
    assert lines[1] == "status           steady: stable"
    assert lines[2] == "FMU's output     0.5 m/s (read without a run)"
    assert "40 drive periods in 3 iterations" in lines[3]
    assert lines[4] == "multipliers      0.900000, 0.100000 (magnitudes)"


def test_no_result_is_reported_without_a_cost() -> None:
    lines = Blocking("slow_beat", "no common period", 0.5, False).describe()
    assert lines[0] == "blocking force   none"
    assert not any("cost" in line for line in lines), "nothing was run"
    assert "prediction_valid = 0" in lines[2], "the FMU says that its output does not hold here"
